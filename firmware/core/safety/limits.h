// The last gate before the bus: no torque passes that is too large, changes too fast, is not finite, or belongs to a
// state in which the arm may not be driven. RT: safe.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "reed/core/safety/reason.h"

namespace reed::protect {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;

template <int N>
struct LimitValues {
  Vec<N> torque = Vec<N>::Zero();        // N·m, symmetric
  Vec<N> torque_step = Vec<N>::Zero();   // N·m per cycle
  Vec<N> position_min = Vec<N>::Zero();  // rad, half the margin taken off
  Vec<N> position_max = Vec<N>::Zero();
  Vec<N> speed = Vec<N>::Zero();  // rad/s
  double contact_force = 0.0;     // N
  int hold_age = 0;               // cycles
  int stop_age = 0;               // cycles
};

/// What the gate found. A trip names the first reason and where; limits is the bit set of those that act.
struct LimitCheck {
  Reason trip = Reason::kNone;
  int joint = -1;
  double value = 0.0;
  std::int32_t limits = 0;
};

template <int N>
class Limits {
 public:
  explicit Limits(const LimitValues<N>& values) noexcept : limit_(values) {}

  /// Is the arm in a state in which torque may flow? Position, speed, contact force, age of the oldest joint.
  LimitCheck CheckState(const Vec<N>& theta, const Vec<N>& theta_dot, double contact_force, int oldest_age,
                        int oldest_joint) const noexcept {
    for (int i = 0; i < N; ++i) {
      if (!(theta[i] >= limit_.position_min[i] && theta[i] <= limit_.position_max[i]))
        return {Reason::kJointPosition, i, theta[i], 0};
      if (!(std::abs(theta_dot[i]) <= limit_.speed[i])) return {Reason::kJointSpeed, i, theta_dot[i], 0};
    }
    if (!(contact_force <= limit_.contact_force)) return {Reason::kContactForce, -1, contact_force, 0};
    if (TooOld(oldest_age))
      return {Reason::kStaleMeasurement, oldest_joint, static_cast<double>(oldest_age), 0};
    return {};
  }

  /// Beyond holding and ramping down.
  bool TooOld(int age) const noexcept { return age > 2 * limit_.stop_age; }

  /// The torque that may be sent instead of `tau_law`. Measurements beyond hold_age: the last torque is held;
  /// beyond stop_age: it ramps down to zero over stop_age more cycles. Held for twice stop_age, because every measurement
  /// comes too late: trip, as with a measurement of that age. Not finite: trip, torque zero.
  Vec<N> Apply(const Vec<N>& tau_law, int oldest_age, LimitCheck& check) noexcept {
    for (int i = 0; i < N; ++i) {
      if (std::isfinite(tau_law[i])) continue;
      check = {Reason::kNotFinite, i, tau_law[i], 0};
      return Release();
    }

    held_cycles_ = oldest_age > limit_.hold_age ? held_cycles_ + 1 : 0;
    if (held_cycles_ > 2 * limit_.stop_age) {
      check = {Reason::kStaleMeasurement, -1, static_cast<double>(oldest_age), check.limits};
      return Release();
    }

    Vec<N> tau = tau_law;
    if (oldest_age <= limit_.stop_age) held_ = sent_;
    if (oldest_age > limit_.stop_age) {
      const double left = 1.0 - static_cast<double>(oldest_age - limit_.stop_age) / limit_.stop_age;
      tau = held_ * (left > 0.0 ? left : 0.0);
      check.limits |= LimitBit(Reason::kRampDown);
    } else if (oldest_age > limit_.hold_age) {
      tau = held_;  // the law has old values: hold the last torque that was based on fresh ones
      check.limits |= LimitBit(Reason::kHeldMeasurement);
    }
    const Vec<N> bounded = tau.cwiseMax(-limit_.torque).cwiseMin(limit_.torque);
    if (bounded != tau) check.limits |= LimitBit(Reason::kTorque);
    const Vec<N> wanted = bounded - sent_;
    const Vec<N> step = wanted.cwiseMax(-limit_.torque_step).cwiseMin(limit_.torque_step);
    if (step != wanted) check.limits |= LimitBit(Reason::kTorqueRate);
    // Where nothing limits, the very torque of the law: sent + (law - sent) would be off by a rounding.
    for (int i = 0; i < N; ++i) sent_[i] = step[i] == wanted[i] ? bounded[i] : sent_[i] + step[i];
    return sent_;
  }

  /// Torque zero at once; the brakes hold the arm.
  Vec<N> Release() noexcept {
    sent_.setZero();
    held_.setZero();
    held_cycles_ = 0;
    return sent_;
  }

 private:
  LimitValues<N> limit_;
  Vec<N> sent_ = Vec<N>::Zero();
  Vec<N> held_ = Vec<N>::Zero();  // the last torque before the measurements became too old
  int held_cycles_ = 0;           // in a row with measurements beyond hold_age
};

}  // namespace reed::protect
