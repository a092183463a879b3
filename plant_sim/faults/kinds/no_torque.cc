// The drive delivers no torque. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class NoTorqueFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double, const Actuation&, const Moment&) noexcept override { return 0.0; }
};

}  // namespace

const Kind kNoTorque{"no_torque",
                     static_cast<std::uint32_t>(Seat::kDrive),
                     "",
                     0,
                     0,
                     0,
                     true,
                     "the drive delivers no torque",
                     &Make<NoTorqueFault>};

}  // namespace reed::plant
