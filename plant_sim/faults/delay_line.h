// A value per channel (joint or axis) as it was some cycles ago; until then, as it was when the fault began. RT: safe.
#pragma once

#include <array>

#include "reed/config/sizes/sizes.h"

namespace reed::plant {

/// kLongest: more cycles than it is ever late.
template <std::size_t kLongest>
class DelayLine {
 public:
  /// since: cycles since the fault began. late: less than kLongest.
  double Of(std::size_t channel, double value, int since, double late) noexcept {
    std::array<double, kLongest>& line = line_[channel];
    if (since == 0) line.fill(value);
    const auto now = static_cast<std::size_t>(since), cycles = static_cast<std::size_t>(late);
    line[now % kLongest] = value;
    return now >= cycles ? line[(now - cycles) % kLongest] : line[(now + 1) % kLongest];
  }

 private:
  std::array<std::array<double, kLongest>, kMaxJoints> line_{};
};

}  // namespace reed::plant
