// A force sensor whose reading does not change although its noise must change it. RT: safe.
//
//   F_k = F_k−1 in every axis and every bit, for kRow fresh readings
//
// A reading with noise of at least half its step repeats in one axis with less than 0.7: kRow in a row by chance are less than
// 0.7^(3·100) = 1e-46.
#pragma once

#include <Eigen/Core>

#include "reed/core/safety/limits.h"

namespace reed::protect {

class FrozenWrench {
 public:
  static constexpr int kRow = 100;

  /// noisy: the data sheet's noise is at least half of the reading's step.
  explicit FrozenWrench(bool noisy) noexcept : noisy_(noisy) {}

  void Reset() noexcept { in_row_ = 0; }

  LimitCheck Step(const Eigen::Vector3d& force, bool fresh) noexcept {
    if (!noisy_ || !fresh) return {};
    in_row_ = force == last_ ? in_row_ + 1 : 0;
    last_ = force;
    if (in_row_ < kRow) return {};
    return {Reason::kFrozenWrench, -1, force.norm(), 0};
  }

 private:
  bool noisy_;
  int in_row_ = 0;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
};

}  // namespace reed::protect
