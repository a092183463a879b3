// What the measurements say about the devices that they come from: one monitor per file, all of them here. A monitor that finds
// something stops the arm. RT: safe.
#pragma once

#include <array>

#include "reed/core/model/mass_moments.h"
#include "reed/core/safety/following_error.h"
#include "reed/core/safety/frozen_wrench.h"
#include "reed/core/safety/joint_follows.h"
#include "reed/core/safety/people_limits.h"
#include "reed/core/safety/speed_agrees.h"
#include "reed/core/safety/standstill.h"
#include "reed/core/safety/torque_delivery.h"
#include "reed/core/safety/torque_explained.h"

namespace reed::protect {

template <int N>
struct MonitorValues {
  Vec<N> torque_allowed = Vec<N>::Constant(1e12);  // N·m, between asked and reported
  Vec<N> speed_allowed = Vec<N>::Constant(1e12);   // rad/s, between the angle's rate and the reported speed
  Vec<N> explained_allowed = Vec<N>::Constant(1e12);  // N·m, between observed and felt
  Vec<N> following_allowed = Vec<N>::Constant(1e12);  // rad/s
  double observer_gain = 80.0;                        // K_o, 1/s
  double stuck_rad = 1e12;
  double frozen_rad = 1e12;
  double standstill_rad = 1e12;
  bool wrench_noisy = false;
  double velocity_filter_hz = 120.0;
  PeopleLimitValues people;
};

/// What the controller made of the measurements in this cycle.
template <int N>
struct Observed {
  const Eigen::Matrix<double, 6, N>& J;  // at the measured angles; rows 0 to 2: of the tool point
  const Vec<N>& s;                       // sliding error (25), rad/s
  const Vec<N>& r;                       // observer (47), N·m
  const Vec<N>& sent;                    // torque that goes out, N·m
  double energy;                         // kinetic, J
  const model::Wrench& felt;             // of the tared sensor at the tool point, N and N·m
  bool force_known;                      // the law tracks the sensor's force
  bool explainable;                      // the sensor's reading is of now, and the law has no ripple
  bool follows;                          // the law leaves no standing error
  bool gap;                              // more than a period has passed since the last cycle
};

template <int N>
class Monitors {
 public:
  /// T: s
  Monitors(const MonitorValues<N>& values, double T) noexcept
      : delivery_(values.torque_allowed),
        wrench_(values.wrench_noisy),
        follows_(values.stuck_rad, values.frozen_rad, T),
        speed_(values.speed_allowed, values.velocity_filter_hz, T),
        standstill_(values.standstill_rad),
        people_(values.people),
        explained_(values.explained_allowed, values.observer_gain, T),
        following_(values.following_allowed) {}

  /// Of an arm before its drives are enabled, and after.
  LimitCheck AtRest(const Measurement<N>& measured, bool ready) noexcept {
    return standstill_.Step(measured, ready);
  }

  /// Before the brakes open: what was before does not count.
  void Reset(const Measurement<N>& measured) noexcept {
    delivery_.Reset();
    wrench_.Reset();
    follows_.Reset(measured.theta);
    speed_.Reset(measured);
    explained_.Reset();
    following_.Reset();
  }

  /// Of an arm that moves. The first finding counts.
  LimitCheck Moving(const Measurement<N>& measured, const Observed<N>& seen) noexcept {
    const Vec<N> v = seen.s + measured.theta_dot;
    const Vec<N> felt = seen.J.template topRows<3>().transpose() * seen.felt.F +
                        seen.J.template bottomRows<3>().transpose() * seen.felt.n;
    const LimitCheck none;
    // Each has its turn in every cycle, so that each sees every cycle.
    const std::array<LimitCheck, 7> found{
        speed_.Step(measured, seen.gap),
        delivery_.Step(measured, seen.sent),
        seen.follows ? follows_.Step(measured, v) : none,
        wrench_.Step(measured.force, measured.wrench_age == 0 && seen.force_known),
        explained_.Step(seen.r, felt, seen.explainable),
        seen.follows ? following_.Step(seen.s) : none,
        CheckNearPeople<N>(people_, measured, seen.J, seen.energy)};
    for (const LimitCheck& check : found)
      if (check.trip != Reason::kNone) return check;
    return none;
  }

 private:
  TorqueDelivery<N> delivery_;
  FrozenWrench wrench_;
  JointFollows<N> follows_;
  SpeedAgrees<N> speed_;
  Standstill<N> standstill_;
  PeopleLimitValues people_;
  TorqueExplained<N> explained_;
  FollowingError<N> following_;
};

}  // namespace reed::protect
