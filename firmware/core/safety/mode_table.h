// When torque may flow: the whole state machine as one table. RT: safe.
#pragma once

#include <array>
#include <cstdint>

namespace reed::mode {

/// kOff: brakes closed, not every joint measured or a drive still braked. kReady: every joint measured,
/// drives ready, brakes closed. kActive: brakes open, the law acts. kFault: torque zero, brakes closed,
/// until a reset.
enum class Mode : std::uint8_t { kOff = 0, kReady = 1, kActive = 2, kFault = 3 };
inline constexpr int kNumModes = 4;
inline constexpr std::array<const char*, kNumModes> kModeNames{"off", "ready", "active", "fault"};

/// kEnable: all joints measured. kStart: the operator's wish, and all drives enabled. kStop: the end of the
/// run or the operator's wish. kTrip: a limit or a loss. kReset: the operator's, after a fault. kBraked: the
/// drives gave up waiting for commands before any torque flowed. kNone: nothing happened.
enum class Event : std::uint8_t {
  kNone = 0,
  kEnable = 1,
  kStart = 2,
  kStop = 3,
  kTrip = 4,
  kReset = 5,
  kBraked = 6
};
inline constexpr int kNumEvents = 7;
inline constexpr std::array<const char*, kNumEvents> kEventNames{"none", "enable", "start", "stop",
                                                                 "trip", "reset",  "braked"};

struct Transition {
  Mode from;
  Event on;
  Mode to;
};

inline constexpr std::array kTransitions{
    Transition{Mode::kOff, Event::kEnable, Mode::kReady},
    Transition{Mode::kReady, Event::kStart, Mode::kActive},
    Transition{Mode::kReady, Event::kStop, Mode::kOff},
    Transition{Mode::kReady, Event::kBraked, Mode::kOff},
    Transition{Mode::kActive, Event::kStop, Mode::kReady},
    Transition{Mode::kFault, Event::kReset, Mode::kOff},
};

constexpr Mode Next(Mode mode, Event event) noexcept {
  if (event == Event::kTrip) return Mode::kFault;  // dominates every mode
  for (const Transition& t : kTransitions)
    if (t.from == mode && t.on == event) return t.to;
  return mode;
}
static_assert(Next(Mode::kFault, Event::kStart) == Mode::kFault);
static_assert(Next(Mode::kOff, Event::kStart) == Mode::kOff,
              "a start before the joints are measured is no start");

}  // namespace reed::mode
