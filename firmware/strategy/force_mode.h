// Force mode: seek the wall, latch on the first contact, track the desired force. The only place that knows
// when the normal direction belongs to the force. RT: safe.
#pragma once

#include <algorithm>
#include <cmath>

#include "firmware/control/force_loop.h"
#include "firmware/reference/force_profile.h"

namespace reed::strategy {

struct ForceModeConfig {
  control::ForceGains gains;
  double threshold_N = 1.0;
  double approach_speed_mps = 0.01;
  double speed_limit_mps = 0.03;
  double approach_time_s = 0.1;  // the approach speed is reached this smoothly
};

/// What the force mode wants of the law this cycle.
struct ForceDemand {
  bool active = false;       // the normal direction belongs to the force loop
  bool latched_now = false;  // contact was made in this cycle
  bool speed_limited = false;
  double f_d = 0.0;  // N
  double e_f = 0.0;  // N, 0 before contact
  double z = 0.0, z_dot = 0.0;
};

class ForceMode {
 public:
  ForceMode(const ForceModeConfig& config, const reference::ForceProfile& profile) noexcept
      : config_(config), profile_(profile) {}

  void Reset() noexcept {
    state_ = {};
    contact_s_ = kNoContact;
  }
  bool in_contact() const noexcept { return contact_s_ < kNoContact; }
  const control::ForceState& state() const noexcept { return state_; }

  /// f: normal force as known now, N. T: period, s.
  ForceDemand Step(double t_s, double f, double T) noexcept {
    ForceDemand demand;
    if (!profile_.Wanted(t_s)) {
      Reset();
      return demand;
    }
    demand.active = true;
    if (!in_contact() && f > config_.threshold_N) {
      contact_s_ = t_s;
      demand.latched_now = true;
    }
    double wanted = 0.0;  // normal speed into the wall
    if (in_contact()) {
      demand.f_d = profile_.At(t_s, contact_s_);
      demand.e_f = demand.f_d - f;
      wanted = control::NormalSpeed(config_.gains, demand.e_f, state_.e_f_integral);
    } else {
      wanted = config_.approach_speed_mps *
               reference::MinimumJerk(t_s - profile_.start_s, config_.approach_time_s).s;
    }
    const double allowed = std::clamp(wanted, -config_.speed_limit_mps, config_.speed_limit_mps);
    demand.speed_limited = allowed != wanted;
    // Anti-windup: no more of what the limit already refuses.
    if (in_contact() && !(demand.speed_limited && wanted * demand.e_f > 0.0))
      state_.e_f_integral += T * demand.e_f;
    demand.z_dot = control::NormalAcceleration(config_.gains, allowed, state_.z);
    demand.z = state_.z;
    // Exact step of ż = a (u − z): stable for any a T.
    state_.z = allowed + (state_.z - allowed) * std::exp(-config_.gains.a * T);
    return demand;
  }

 private:
  static constexpr double kNoContact = 1e12;
  ForceModeConfig config_;
  reference::ForceProfile profile_;
  control::ForceState state_;
  double contact_s_ = kNoContact;
};

}  // namespace reed::strategy
