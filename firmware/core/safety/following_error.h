// Following error: a joint's speed is not the one that the law asks for. A loop that oscillates has it, too. RT: safe.
//
//   |s| > allowed, for kRow cycles      s = v − θ̇ (25), rad/s
#pragma once

#include <cmath>

#include "reed/core/safety/in_row.h"
#include "reed/core/safety/limits.h"

namespace reed::protect {

template <int N>
class FollowingError {
 public:
  static constexpr int kRow = 5;  // an oscillation of up to 50 Hz stays beyond for as long

  /// allowed: rad/s
  explicit FollowingError(const Vec<N>& allowed) noexcept : allowed_(allowed) {}

  void Reset() noexcept { in_row_.Reset(); }

  LimitCheck Step(const Vec<N>& s) noexcept {
    LimitCheck check;
    for (int i = 0; i < N; ++i) {
      if (in_row_.Add(i, std::abs(s[i]) > allowed_[i]) && check.trip == Reason::kNone)
        check = {Reason::kFollowingError, i, s[i], 0};
    }
    return check;
  }

 private:
  Vec<N> allowed_;
  InRow<N> in_row_{kRow};
};

}  // namespace reed::protect
