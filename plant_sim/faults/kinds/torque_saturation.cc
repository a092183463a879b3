// The drive's torque does not exceed a bound. RT: safe.
#include <algorithm>

#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class TorqueSaturationFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double asked_Nm, const Actuation&, const Moment&) noexcept override {
    return std::clamp(asked_Nm, -size(), size());
  }
};

}  // namespace

const Kind kTorqueSaturation{"torque_saturation",
                             static_cast<std::uint32_t>(Seat::kDrive),
                             "N·m",
                             0.5,
                             0.001,
                             1000.0,
                             false,
                             "the drive's torque does not exceed a bound",
                             &Make<TorqueSaturationFault>};

}  // namespace reed::plant
