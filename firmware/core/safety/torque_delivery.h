// Does a drive deliver the torque that it was asked? RT: safe.
//
//   distance of τ_reported from [min(τ_k−1, τ_k−2), max(τ_k−1, τ_k−2)]  >  share of the torque limit, for kRow cycles
//
// The drive reports at a SYNC what it applies: the command of the last cycle, or of the one before where commands wait for the
// next SYNC.
#pragma once

#include <algorithm>

#include "reed/core/measurement.h"
#include "reed/core/safety/in_row.h"
#include "reed/core/safety/limits.h"

namespace reed::protect {

template <int N>
class TorqueDelivery {
 public:
  static constexpr int kRow = 15;  // more than commands that are lost in a row without a stop

  /// allowed: N·m
  explicit TorqueDelivery(const Vec<N>& allowed) noexcept : allowed_(allowed) {}

  void Reset() noexcept {
    in_row_.Reset();
    last_.setZero();
    before_.setZero();
  }

  /// sent: the torque that goes out in this cycle.
  LimitCheck Step(const Measurement<N>& measured, const Vec<N>& sent) noexcept {
    LimitCheck check;
    for (int i = 0; i < N; ++i) {
      if (measured.age[static_cast<std::size_t>(i)] != 0) continue;
      const double reported = measured.torque[i];
      const double asked =
          std::clamp(reported, std::min(last_[i], before_[i]), std::max(last_[i], before_[i]));
      const bool off = !(std::abs(reported - asked) <= allowed_[i]);
      if (in_row_.Add(i, off) && check.trip == Reason::kNone)
        check = {Reason::kTorqueNotDelivered, i, reported - asked, 0};
    }
    before_ = last_;
    last_ = sent;
    return check;
  }

 private:
  Vec<N> allowed_;
  Vec<N> last_ = Vec<N>::Zero(), before_ = Vec<N>::Zero();
  InRow<N> in_row_{kRow};
};

}  // namespace reed::protect
