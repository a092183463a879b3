// The wrench sensor's zero: the mean of what it reads while the arm touches nothing. RT: safe.
#pragma once

#include <Eigen/Core>

namespace reed::strategy {

class ForceTare {
 public:
  /// Averages at most this many readings; then the zero stays.
  static constexpr int kReadings = 64;

  void Take(const Eigen::Vector3d& force) noexcept {
    if (count_ >= kReadings) return;
    ++count_;
    zero_ += (force - zero_) / count_;
  }
  double Norm() const noexcept { return zero_.norm(); }
  bool complete() const noexcept { return count_ >= kReadings; }
  /// What the environment does to the arm: without a zero as read.
  Eigen::Vector3d Felt(const Eigen::Vector3d& force) const noexcept {
    return complete() ? Apply(force) : force;
  }
  Eigen::Vector3d Apply(const Eigen::Vector3d& force) const noexcept { return force - zero_; }

 private:
  Eigen::Vector3d zero_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

}  // namespace reed::strategy
