// Monitored standstill: an arm whose brakes are closed stays where it is, before a start and after a protective stop. RT: safe.
//
//   |θ − θ_0| <= allowed      θ_0: when the drives are ready; after they were enabled kSettle cycles later
#pragma once

#include <cmath>

#include "reed/core/measurement.h"
#include "reed/core/safety/limits.h"

namespace reed::protect {

template <int N>
class Standstill {
 public:
  static constexpr int kSettle = 50;  // cycles: brakes close within some 10 ms

  explicit Standstill(double allowed_rad) noexcept : allowed_rad_(allowed_rad) {}

  /// ready: the controller is, so the drives hold the arm with their brakes until they are enabled.
  LimitCheck Step(const Measurement<N>& measured, bool ready) noexcept {
    if (measured.AnyDrive(DriveState::kEnabled)) settling_ = kSettle;
    if (!ready || !measured.AllDrives(DriveState::kReady)) {
      at_known_ = false;
      return {};
    }
    if (measured.OldestAge() != 0) return {};
    if (settling_ > 0 || !at_known_) at_ = measured.theta;
    settling_ -= settling_ > 0 ? 1 : 0;
    at_known_ = true;
    for (int i = 0; i < N; ++i)
      if (!(std::abs(measured.theta[i] - at_[i]) <= allowed_rad_))
        return {Reason::kNotAtStandstill, i, measured.theta[i] - at_[i], 0};
    return {};
  }

 private:
  double allowed_rad_;
  int settling_ = 0;  // cycles left
  bool at_known_ = false;
  Vec<N> at_ = Vec<N>::Zero();
};

}  // namespace reed::protect
