// The drive's torque has the other sign. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class TorqueSignFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double asked_Nm, const Actuation&, const Moment&) noexcept override {
    return -asked_Nm;
  }
};

}  // namespace

const Kind kTorqueSign{"torque_sign",
                       static_cast<std::uint32_t>(Seat::kDrive),
                       "",
                       0,
                       0,
                       0,
                       false,
                       "the drive's torque has the other sign",
                       &Make<TorqueSignFault>};

}  // namespace reed::plant
