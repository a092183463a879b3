// The joint has more Coulomb friction. RT: safe.
#include <algorithm>

#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class ExtraFrictionFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int joint, double asked_Nm, const Actuation& act, const Moment&) noexcept override {
    constexpr double kSmooth_radps = 0.01;
    return asked_Nm - size() * std::clamp(act.motor_speed_radps[joint] / kSmooth_radps, -1.0, 1.0);
  }
};

}  // namespace

const Kind kExtraFriction{"extra_friction",
                          static_cast<std::uint32_t>(Seat::kDrive),
                          "N·m",
                          1.0,
                          0.001,
                          1000.0,
                          false,
                          "the joint has more Coulomb friction",
                          &Make<ExtraFrictionFault>};

}  // namespace reed::plant
