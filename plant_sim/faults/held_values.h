// A value per channel (joint or axis) as it was when a fault began. RT: safe.
#pragma once

#include <array>

#include "reed/config/sizes/sizes.h"

namespace reed::plant {

class HeldValues {
 public:
  /// begins: the fault's first cycle.
  double Of(std::size_t channel, double value, bool begins) noexcept {
    if (begins) held_[channel] = value;
    return held_[channel];
  }

 private:
  std::array<double, kMaxJoints> held_{};
};

}  // namespace reed::plant
