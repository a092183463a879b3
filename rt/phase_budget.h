// How long each phase of a cycle may take, and what follows when one takes longer. Pure functions of measured
// times, so that every rule is tested without waiting. Units: ns. RT: safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace reed::rt {

enum class Phase : std::uint8_t { kReceive, kCompute, kTransmit };
inline constexpr std::size_t kPhases = 3;

/// What the next cycle does after a phase was too long.
enum class PhaseAction : std::uint8_t {
  kCount,    // nothing: the breach is counted and reported
  kHold,     // repeats the last safe command
  kDegrade,  // no adaptation, the static deflection keeps its last value
  kFault,    // nothing, but after max_in_row such cycles in a row the arm stops
};

/// Of one cycle, in the order of Phase.
using PhaseTimes = std::array<std::int32_t, kPhases>;

/// The last cycles' phase times, oldest first.
inline constexpr std::size_t kPhaseMemory = 3;
using PhaseHistory = std::array<PhaseTimes, kPhaseMemory>;

struct PhaseLimits {
  PhaseTimes budget_ns{};
  PhaseAction action = PhaseAction::kCount;
  int max_in_row = 20;  // kFault: more cycles in a row with a broken limit stop the arm
};

struct PhaseCheck {
  bool broken = false;            // some phase of this cycle was too long
  Phase phase = Phase::kReceive;  // the first that was
  bool first = false;             // the cycle before was within its limits: worth an event
  bool hold_next = false;
  bool degrade_next = false;
  bool fault = false;
};

class PhaseMonitor {
 public:
  explicit PhaseMonitor(const PhaseLimits& limits) noexcept : limits_(limits) {}

  /// Once per cycle, with its own times.
  PhaseCheck Check(const PhaseTimes& times) noexcept {
    history_[0] = history_[1];
    history_[1] = history_[2];
    history_[2] = times;
    PhaseCheck check;
    for (std::size_t i = kPhases; i-- > 0;) {
      if (times[i] <= limits_.budget_ns[i]) continue;
      ++broken_[i];
      check.broken = true;
      check.phase = static_cast<Phase>(i);
    }
    if (!check.broken) {
      in_row_ = 0;
      return check;
    }
    check.first = in_row_ == 0;
    if (in_row_ <= limits_.max_in_row) ++in_row_;
    check.hold_next = limits_.action == PhaseAction::kHold;
    check.degrade_next = limits_.action == PhaseAction::kDegrade;
    check.fault = limits_.action == PhaseAction::kFault && in_row_ > limits_.max_in_row;
    return check;
  }

  const PhaseHistory& history() const noexcept { return history_; }
  int in_row() const noexcept { return in_row_; }
  /// Cycles so far in which this phase was too long.
  std::int64_t broken(Phase phase) const noexcept { return broken_[static_cast<std::size_t>(phase)]; }

 private:
  PhaseLimits limits_;
  PhaseHistory history_{};
  std::array<std::int64_t, kPhases> broken_{};
  int in_row_ = 0;
};

}  // namespace reed::rt
