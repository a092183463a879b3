// The torque of each joint as it was when a fault began. RT: safe.
#pragma once

#include <array>

#include "reed/config/sizes/sizes.h"

namespace reed::plant {

class HeldTorque {
 public:
  double Of(int joint, double asked_Nm, bool first) noexcept {
    double& held = held_Nm_[static_cast<std::size_t>(joint)];
    if (first) held = asked_Nm;
    return held;
  }

 private:
  std::array<double, kMaxJoints> held_Nm_{};
};

}  // namespace reed::plant
