// May torque flow? Everything but the arm's own limits (limits.h): who sends, who answers, which
// drives are enabled, how late the controller is. RT: safe.
#pragma once

#include <algorithm>

#include "reed/core/contact/force_source.h"
#include "reed/core/cycle_state.h"
#include "reed/core/measurement.h"
#include "reed/core/safety/limits.h"
#include "reed/core/safety/start_watch.h"
#include "reed/core/safety/supervisor.h"

namespace reed::protect {

template <int N>
class Watch {
 public:
  explicit Watch(double T) noexcept : T_(T), start_(T) {}

  /// Trips are checked only while torque may flow: an arm at rest behind closed brakes is safe. One that waits for its
  /// force sensor's zero trips where that sensor is at the end of its range: it would wait for ever. source: of the last
  /// cycle. contact_force: the force on the wall as far as it is known, N.
  LimitCheck CheckState(const Measurement<N>& measured, const CycleState& state,
                        const mode::Supervisor& supervisor, const Limits<N>& limits,
                        strategy::ForceSource source, double contact_force) noexcept {
    const LimitCheck no_start = start_.Check(measured, supervisor);
    NoteAbsence(state);
    return NameAbsence(Check(measured, state, supervisor, limits, source, contact_force, no_start));
  }

 private:
  LimitCheck Check(const Measurement<N>& measured, const CycleState& state,
                   const mode::Supervisor& supervisor, const Limits<N>& limits, strategy::ForceSource source,
                   double contact_force, const LimitCheck& no_start) const noexcept {
    const bool active = supervisor.mode() == mode::Mode::kActive;
    if (measured.foreign_controller) return {Reason::kForeignController, -1, 0.0, 0};
    if (measured.unexpected_joint >= 0) return {Reason::kUnexpectedJoint, measured.unexpected_joint, 0.0, 0};
    if (no_start.trip != Reason::kNone) return no_start;
    const bool wrench_fresh = !limits.TooOld(measured.wrench_age);
    const bool saturated = wrench_fresh && measured.wrench_saturated;
    if (supervisor.Request() != DriveRequest::kEnable)
      return saturated && supervisor.awaits_tare() ? WrenchRange(measured) : LimitCheck{};
    if (active && state.missed_in_row_exceeded)
      return {Reason::kMissedCycles, -1, static_cast<double>(state.missed_in_row), 0};
    if (active && state.phase_budget_exceeded)
      return {Reason::kPhaseBudgetInRow, -1, static_cast<double>(state.broken_in_row), 0};
    for (int i = 0; i < N; ++i) {
      const DriveState drive = measured.drive[static_cast<std::size_t>(i)];
      if (!DriveStateAllowed(drive, supervisor))
        return {Reason::kDriveFault, i, static_cast<double>(drive), 0};
    }
    // A law that tracks the measured force may not press without it. A law that needs none has another source.
    if (active && source == strategy::ForceSource::kKnown && !wrench_fresh)
      return {Reason::kStaleWrench, -1, static_cast<double>(measured.wrench_age), 0};
    const LimitCheck check = limits.CheckState(measured.theta, measured.theta_dot, contact_force,
                                               measured.OldestAge(), measured.OldestJoint());
    return check.trip == Reason::kNone && saturated ? WrenchRange(measured) : check;
  }

  /// The readings are lower bounds: no force, and no zero for a sensor that waits for one.
  static LimitCheck WrenchRange(const Measurement<N>& measured) noexcept {
    return {Reason::kWrenchRange, -1, measured.force.cwiseAbs().maxCoeff(), 0};
  }

  /// Grid points that the controller missed in a row.
  void NoteAbsence(const CycleState& state) noexcept {
    if (state.missed_in_row_exceeded) absent_cycles_ = state.missed_in_row;
    cycles_since_absence_ =
        state.missed_in_row_exceeded ? 0 : std::min(cycles_since_absence_ + 1, Measurement<N>::kNever);
  }

  /// A measurement that is old because the controller missed cycles: the missed cycles are the reason to report.
  LimitCheck NameAbsence(const LimitCheck& check) const noexcept {
    const bool stale = check.trip == Reason::kStaleMeasurement || check.trip == Reason::kStaleWrench;
    if (stale && absent_cycles_ > 0 && cycles_since_absence_ <= check.value)
      return {Reason::kMissedCycles, -1, static_cast<double>(absent_cycles_), 0};
    return check;
  }

  /// Of a drive that is requested to enable. The others already have torque while one of them is still enabling. A
  /// drive that has braked needs a new start (supervisor.h).
  bool DriveStateAllowed(DriveState drive, const mode::Supervisor& supervisor) const noexcept {
    if (supervisor.mode() == mode::Mode::kActive || supervisor.cycles_enabling() * T_ > kTimeToEnable_s)
      return drive == DriveState::kEnabled;
    return drive != DriveState::kFault;
  }

  static constexpr double kTimeToEnable_s = 1.0;  // a brake takes some 0.1 s to open

  double T_;
  int absent_cycles_ = 0;  // of the last absence
  int cycles_since_absence_ = Measurement<N>::kNever;
  StartWatch<N> start_;
};

}  // namespace reed::protect
