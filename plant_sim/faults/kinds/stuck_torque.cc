// The drive's torque stays what it is. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/held_values.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class StuckTorqueFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int joint, double asked_Nm, const Actuation&, const Moment& at) noexcept override {
    return held_.Of(static_cast<std::size_t>(joint), asked_Nm, at.since == 0);
  }
  HeldValues held_;
};

}  // namespace

const Kind kStuckTorque{"stuck_torque",
                        static_cast<std::uint32_t>(Seat::kDrive),
                        "",
                        0,
                        0,
                        0,
                        true,
                        "the drive's torque stays what it is",
                        &Make<StuckTorqueFault>};

}  // namespace reed::plant
