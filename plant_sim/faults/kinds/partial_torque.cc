// The drive delivers a share of the torque. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class PartialTorqueFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double asked_Nm, const Actuation&, const Moment&) noexcept override {
    return size() * asked_Nm;
  }
};

}  // namespace

const Kind kPartialTorque{"partial_torque",
                          static_cast<std::uint32_t>(Seat::kDrive),
                          "1",
                          0.5,
                          0,
                          0.999,
                          false,
                          "the drive delivers a share of the torque",
                          &Make<PartialTorqueFault>};

}  // namespace reed::plant
