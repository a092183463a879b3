// The drive delivers its largest torque. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class FullTorqueFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int joint, double, const Actuation& act, const Moment&) noexcept override {
    return size() * act.limit_Nm[joint];
  }
};

}  // namespace

const Kind kFullTorque{
    "full_torque", static_cast<std::uint32_t>(Seat::kDrive), "share of the limit",  1, -1, 1,
    true,          "the drive delivers its largest torque",  &Make<FullTorqueFault>};

}  // namespace reed::plant
