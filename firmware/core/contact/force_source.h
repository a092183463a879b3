// Which law acts (Fig. 7): by what is known of the force now. RT: safe.
//
// In `auto` only the age of the last valid wrench frame decides. A frame that is late, missing or fails its E2E
// check ages. A saturated or constant reading is still a reading. Lost after kLossCycles cycles without a valid
// frame, back after kReturnCycles in a row with one.
#pragma once

#include <algorithm>
#include <cstdint>

namespace reed::strategy {

/// kObserver: the arm presses, and the momentum observer replaces the sensor.
enum class ForceSource : std::int8_t { kNone = 0, kKnown = 1, kUnknown = 2, kObserver = 3 };

/// What is known of the force, as configured. kAuto: by the age of the wrench.
enum class SourceSetting : std::uint8_t { kNone, kKnown, kUnknown, kAuto };

class SourceSelector {
 public:
  static constexpr int kLossCycles = 3;
  static constexpr int kReturnCycles = 100;

  explicit SourceSelector(SourceSetting configured) noexcept : configured_(configured) {}

  /// wrench_age: cycles since the last valid frame. presses: a normal force is desired now.
  ForceSource Step(int wrench_age, bool presses) noexcept {
    fresh_in_row_ = wrench_age == 0 ? std::min(fresh_in_row_ + 1, kReturnCycles) : 0;
    if (wrench_age >= kLossCycles) lost_ = true;
    if (fresh_in_row_ >= kReturnCycles) lost_ = false;
    if (configured_ == SourceSetting::kNone) return ForceSource::kNone;
    const bool known =
        configured_ == SourceSetting::kKnown || (configured_ == SourceSetting::kAuto && !lost_);
    if (known) return ForceSource::kKnown;
    return presses ? ForceSource::kObserver : ForceSource::kUnknown;
  }

  /// The frames are back but not yet used: the time to take a new zero.
  bool returning() const noexcept { return lost_ && fresh_in_row_ > 0; }
  int fresh_in_row() const noexcept { return fresh_in_row_; }

 private:
  SourceSetting configured_;
  int fresh_in_row_ = 0;
  bool lost_ = false;
};

}  // namespace reed::strategy
