// The drive adds a constant torque. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class TorqueOffsetFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double asked_Nm, const Actuation&, const Moment&) noexcept override {
    return asked_Nm + size();
  }
};

}  // namespace

const Kind kTorqueOffset{"torque_offset",
                         static_cast<std::uint32_t>(Seat::kDrive),
                         "N·m",
                         1.0,
                         -1000.0,
                         1000.0,
                         false,
                         "the drive adds a constant torque",
                         &Make<TorqueOffsetFault>};

}  // namespace reed::plant
