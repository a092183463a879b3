// Force mode: seek the wall, latch on the first contact, track the desired force with gains that fit the wall.
// Before and after the time of the force the arm touches the wall with f_d = 0 while the path leads into it. Only
// this file decides when the force loop moves the normal direction. RT: safe.
#pragma once

#include <algorithm>

#include "reed/core/contact/force_loop.h"
#include "reed/core/contact/normal_anchor.h"
#include "reed/core/contact/stretch_guard.h"
#include "reed/core/contact/wall_stiffness.h"
#include "reed/core/reference/force_profile.h"
#include "reed/math/exponential.h"

namespace reed::strategy {

struct ForceModeConfig {
  control::ForceGains gains;
  double threshold_N = 1.0;
  double approach_speed_mps = 0.01;
  double speed_limit_mps = 0.03;
  bool schedule = false;                        // k_p follows the estimated stiffness (52)
  double bandwidth_radps = 60.0;                // ω_f of (52)
  double approach_time_s = 0.1;                 // the approach speed is reached this smoothly
  double least_k_p = 0.5e-3, most_k_p = 30e-3;  // m/(s·N), bounds of (52)
};

/// What the force mode demands of the law in this cycle.
struct ForceDemand {
  bool active = false;       // the force loop moves the normal direction
  bool latched_now = false;  // contact was made in this cycle
  bool speed_limited = false;
  bool held = false;      // near a stretched arm (stretch_guard.h)
  bool held_now = false;  // since this cycle
  bool lost = false;      // the arm cannot press in this pose
  double f_d = 0.0;       // N
  double e_f = 0.0;       // N, 0 before contact
  double z = 0.0, z_dot = 0.0;
};

/// Of the geometry in this cycle.
struct NormalMotion {
  double x = 0.0;          // normal tip position by motor angles, m
  double path_gap = -1.0;  // how far the path leads off the wall from there, m; < 0: into it
  NormalSpeedRange allowed;
};

class ForceMode {
 public:
  ForceMode(const ForceModeConfig& config, const reference::ForceProfile& profile, double T) noexcept
      : config_(config),
        profile_(profile),
        wall_(config.bandwidth_radps / config.gains.k_p, T),
        anchor_(T),
        T_(T),
        follow_(math::Exp(-config.gains.a * T)),
        forget_(math::Exp(-T / kForget_s)) {}

  void Reset() noexcept {
    state_ = {};
    contact_s_ = kNoContact;
    wall_.Reset();
    anchor_.Reset();
    held_ = false;
  }
  bool in_contact() const noexcept { return contact_s_ < kNoContact; }
  /// A force is desired now, or the wall is still touched.
  bool Wanted(double t_s) const noexcept { return profile_.Wanted(t_s) || in_contact(); }
  const control::ForceState& state() const noexcept { return state_; }
  double wall_stiffness() const noexcept { return wall_.value(); }

  /// f: normal force as known now, N. bandwidth_scale: below 1 where f comes late. sensed: f is measured, not
  /// observed.
  ForceDemand Step(double t_s, double f, const NormalMotion& motion, double bandwidth_scale,
                   bool sensed = true) noexcept {
    ForceDemand demand;
    const bool pressing = profile_.Wanted(t_s);
    if (!pressing && !Touches(f, motion.path_gap, sensed)) {
      Reset();
      return demand;
    }
    demand.active = true;
    if (!in_contact() && f > config_.threshold_N) {
      contact_s_ = t_s;
      demand.latched_now = true;
    }
    const double into = std::min(config_.speed_limit_mps, motion.allowed.into);
    const double off = std::min(config_.speed_limit_mps, motion.allowed.off);
    double wanted = 0.0;  // normal speed into the wall
    if (in_contact()) {
      if (bandwidth_scale > kPromptScale) wall_.Step(f, motion.x);  // a late f gives a wrong stiffness
      demand.f_d = profile_.At(t_s, contact_s_);
      demand.e_f = demand.f_d - f;
      wanted = pressing ? control::NormalSpeed(Gains(bandwidth_scale), demand.e_f, state_.e_f_integral)
                        : Yield(f, bandwidth_scale, motion.x);
    } else {
      wanted = config_.approach_speed_mps *
               reference::MinimumJerk(t_s - profile_.start_s, config_.approach_time_s).s;
      wanted += anchor_.Step(motion.x, std::min(wanted, into));
    }
    const double allowed = std::clamp(wanted, -off, into);
    demand.speed_limited = allowed != wanted;
    demand.held = motion.allowed.held;
    demand.held_now = demand.held && !held_;
    demand.lost = motion.allowed.lost;
    held_ = demand.held;
    // Anti-windup: no integration beyond the speed limit.
    if (pressing && in_contact() && !(demand.speed_limited && wanted * demand.e_f > 0.0))
      state_.e_f_integral += T_ * demand.e_f;
    demand.z_dot = control::NormalAcceleration(config_.gains, allowed, state_.z);
    demand.z = state_.z;
    // Exact step of ż = a (u − z): stable for any a T.
    state_.z = allowed + (state_.z - allowed) * follow_;
    return demand;
  }

  /// (52): k_i keeps its ratio to k_p, so that k_i < a k_p holds on every wall.
  control::ForceGains Gains(double bandwidth_scale) const noexcept {
    const double k_p = config_.schedule ? std::clamp(config_.bandwidth_radps / wall_.value(),
                                                     config_.least_k_p, config_.most_k_p)
                                        : config_.gains.k_p;
    return {bandwidth_scale * k_p,
            bandwidth_scale * bandwidth_scale * config_.gains.k_i * k_p / config_.gains.k_p, config_.gains.a};
  }

 private:
  /// Contact without a desired force: before its start, on a wall that is higher than assumed, or after its end.
  /// The arm touches the wall with f_d = 0 until the path leads off it. An observed force may be a weight error:
  /// alone it makes no contact.
  bool Touches(double f, double path_gap, bool sensed) const noexcept {
    if (!(profile_.desired_N > 0.0) || path_gap > kLeaves_m) return false;
    return in_contact() || (sensed && f > config_.threshold_N);
  }

  /// Normal speed at f_d = 0: yields to a force above half of the contact threshold. Less may be the sensor's error:
  /// there the tip holds its position, because following an error would drift without end.
  double Yield(double f, double bandwidth_scale, double x) noexcept {
    state_.e_f_integral *= forget_;
    const double half = 0.5 * config_.threshold_N;
    const double felt = f - std::clamp(f, -half, half);
    const double z_d = control::NormalSpeed(Gains(bandwidth_scale), -felt, state_.e_f_integral);
    if (felt == 0.0) return z_d + anchor_.Step(x, z_d);
    anchor_.Reset();
    return z_d;
  }

  static constexpr double kLeaves_m = 0.2e-3;
  static constexpr double kForget_s = 0.1;
  static constexpr double kNoContact = 1e12;
  static constexpr double kPromptScale = 0.99;
  ForceModeConfig config_;
  reference::ForceProfile profile_;
  WallStiffness wall_;
  NormalAnchor anchor_;
  double T_;
  double follow_, forget_;  // what is left after a period
  control::ForceState state_;
  double contact_s_ = kNoContact;
  bool held_ = false;
};

}  // namespace reed::strategy
