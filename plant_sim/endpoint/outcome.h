// How a simulation ends, and the exit status that says so.
#pragma once

namespace reed::plant {

enum class Outcome {
  kRunning,
  kStopped,      // a signal, or the asked duration is over
  kWrongLayout,  // controller and plant were built from different DBCs
  kDiverged,     // the arm's state is not finite or absurd
  kBusLost,
};

constexpr int ExitStatus(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kRunning:
    case Outcome::kStopped:
      return 0;
    case Outcome::kWrongLayout:
      return 2;
    case Outcome::kDiverged:
    case Outcome::kBusLost:
      return 3;
  }
  return 3;
}

}  // namespace reed::plant
