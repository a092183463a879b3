// Which law is in charge (Fig. 7): by what is known of the force right now. RT: safe.
//
// In `auto` the age of the last sound wrench frame decides and nothing else: a frame that is late, missing,
// or fails its E2E check ages; a saturated or constant reading is still a reading. Lost after kLossCycles
// cycles without a sound frame; back after kReturnCycles in a row with one.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reed/config/controller/controller_config.h"

namespace reed::strategy {

/// kObserver: the arm presses, and the momentum observer stands in for the sensor.
enum class ForceSource : std::int8_t { kNone = 0, kKnown = 1, kUnknown = 2, kObserver = 3 };

class SourceSelector {
 public:
  static constexpr int kLossCycles = 3;
  static constexpr int kReturnCycles = 100;

  explicit SourceSelector(ForceConfig::Source configured) noexcept : configured_(configured) {}

  /// wrench_age: cycles since the last sound frame. presses: a normal force is wanted now.
  ForceSource Step(int wrench_age, bool presses) noexcept {
    fresh_in_row_ = wrench_age == 0 ? std::min(fresh_in_row_ + 1, kReturnCycles) : 0;
    if (wrench_age >= kLossCycles) lost_ = true;
    if (fresh_in_row_ >= kReturnCycles) lost_ = false;
    using Source = ForceConfig::Source;
    if (configured_ == Source::kNone) return ForceSource::kNone;
    const bool known = configured_ == Source::kKnown || (configured_ == Source::kAuto && !lost_);
    if (known) return ForceSource::kKnown;
    return presses ? ForceSource::kObserver : ForceSource::kUnknown;
  }

  /// The frames are back but not yet trusted: the time to take a new zero.
  bool returning() const noexcept { return lost_ && fresh_in_row_ > 0; }
  int fresh_in_row() const noexcept { return fresh_in_row_; }

 private:
  ForceConfig::Source configured_;
  int fresh_in_row_ = 0;
  bool lost_ = false;
};

}  // namespace reed::strategy
