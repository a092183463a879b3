// The wrench sensor's zero: the mean of what it reads while the arm touches nothing. RT: safe.
#pragma once

#include "reed/core/model/mass_moments.h"

namespace reed::strategy {

class WrenchTare {
 public:
  /// Averages at most this many readings; then the zero stays.
  static constexpr int kReadings = 64;

  void Take(const model::Wrench& read) noexcept {
    if (count_ >= kReadings) return;
    ++count_;
    zero_.F += (read.F - zero_.F) / count_;
    zero_.n += (read.n - zero_.n) / count_;
  }
  double Force() const noexcept { return zero_.F.norm(); }
  bool complete() const noexcept { return count_ >= kReadings; }
  /// What the environment does to the arm: without a zero as read.
  model::Wrench Felt(const model::Wrench& read) const noexcept {
    return complete() ? model::Wrench{read.F - zero_.F, read.n - zero_.n} : read;
  }
  Eigen::Vector3d Apply(const Eigen::Vector3d& force) const noexcept { return force - zero_.F; }

 private:
  model::Wrench zero_;
  int count_ = 0;
};

}  // namespace reed::strategy
