// Steps the mode table: what happened in this cycle, which mode follows, what to request of the drives. Enabling is
// explicit: without the operator's wish the arm stays ready with its brakes closed. RT: safe.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reed/core/safety/drive_state.h"
#include "reed/core/safety/mode_table.h"

namespace reed::mode {

/// What the supervisor needs to know of one cycle.
struct Observation {
  bool all_fresh = false;       // every joint answered this cycle
  bool drives_ready = false;    // every drive says ready
  bool drives_enabled = false;  // every drive says enabled
  bool drives_braked = false;   // any drive says braked: commands had stopped for too long
  bool tared = false;           // force sensor tared
  bool stop = false;            // end of the run, or the operator
  bool trip = false;            // a limit, or a loss
  bool reset = false;           // the operator has seen the fault
};

class Supervisor {
 public:
  /// Cycles in which every joint answered, before the drives are asked for anything.
  static constexpr int kFreshInRow = 10;

  /// start_wanted: the operator's wish to open the brakes.
  explicit Supervisor(bool start_wanted) noexcept : start_wanted_(start_wanted) {}

  /// @returns the event that was acted on
  Event Step(const Observation& seen) noexcept {
    const Event event = Classify(seen);
    mode_ = Next(mode_, event);
    ++cycles_in_mode_;
    if (event != Event::kNone) cycles_in_mode_ = 0;
    if (mode_ == Mode::kReady) enabling_ = enabling_ || (start_wanted_ && seen.drives_ready && seen.tared);
    if (mode_ != Mode::kReady) enabling_ = false;
    cycles_enabling_ = enabling_ ? cycles_enabling_ + 1 : 0;
    if (event == Event::kStop || event == Event::kTrip) start_wanted_ = false;  // a wish counts once
    return event;
  }

  Mode mode() const noexcept { return mode_; }
  bool start_wanted() const noexcept { return start_wanted_; }
  bool enabling() const noexcept { return enabling_; }
  /// The operator wants it, and the drives are not asked to enable yet.
  bool awaits_start() const noexcept {
    return start_wanted_ && !enabling_ && (mode_ == Mode::kOff || mode_ == Mode::kReady);
  }
  /// Everything is ready but the force sensor's zero may be missing.
  bool awaits_tare() const noexcept { return awaits_start() && mode_ == Mode::kReady; }
  int cycles_enabling() const noexcept { return cycles_enabling_; }
  std::int64_t cycles_in_mode() const noexcept { return cycles_in_mode_; }

  DriveRequest Request() const noexcept {
    switch (mode_) {
      case Mode::kReady:
        return enabling_ ? DriveRequest::kEnable : DriveRequest::kReady;
      case Mode::kActive:
        return DriveRequest::kEnable;
      case Mode::kOff:
      case Mode::kFault:
        break;
    }
    return DriveRequest::kOff;
  }

 private:
  Event Classify(const Observation& seen) noexcept {
    if (mode_ == Mode::kFault) return seen.reset && !seen.trip ? Event::kReset : Event::kNone;
    if (seen.trip) return Event::kTrip;
    if (seen.stop && (mode_ == Mode::kActive || mode_ == Mode::kReady)) return Event::kStop;
    fresh_in_row_ = seen.all_fresh ? std::min(fresh_in_row_ + 1, kFreshInRow) : 0;
    if (mode_ == Mode::kReady && seen.drives_braked) {  // braked ends by asking for off only
      fresh_in_row_ = 0;
      return Event::kBraked;
    }
    if (mode_ == Mode::kOff && fresh_in_row_ >= kFreshInRow && !seen.stop && !seen.drives_braked)
      return Event::kEnable;
    if (mode_ == Mode::kReady && enabling_ && seen.drives_enabled) return Event::kStart;
    return Event::kNone;
  }

  bool start_wanted_;
  bool enabling_ = false;
  int fresh_in_row_ = 0;
  std::int64_t cycles_in_mode_ = 0;
  int cycles_enabling_ = 0;  // for how long the drives have been asked
  Mode mode_ = Mode::kOff;
};

}  // namespace reed::mode
