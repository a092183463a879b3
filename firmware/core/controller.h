// The controller: a measurement in, a command and a decision out, once per period. It has no access to files, frames,
// clocks or the truth. Firmware, bench, inspection, the Cortex-M7 and other programs call this one object.
// RT: safe, except the constructor.
#pragma once

#include "reed/core/cycle_state.h"
#include "reed/core/events.h"
#include "reed/core/measurement.h"
#include "reed/core/safety/limits.h"
#include "reed/core/safety/monitors.h"
#include "reed/core/safety/supervisor.h"
#include "reed/core/safety/watch.h"
#include "reed/core/separated.h"
#include "reed/core/settings.h"

namespace reed {

/// What the drives get.
template <int N>
struct Command {
  DriveRequest request = DriveRequest::kOff;
  model::Vec<N> torque = model::Vec<N>::Zero();  // N·m
};

template <int N, int P>
class Controller {
 public:
  /// path: the planned motion, over knots that outlive this object. external: the law where settings.law is kExternal.
  Controller(const Settings<N, P>& settings, reference::JointPath<N> path,
             const strategy::ExternalLaw* external = nullptr) noexcept;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  /// One period: estimate, decide, control, protect.
  const Command<N>& Step(const Measurement<N>& measured, const CycleState& state) noexcept;

  /// Nothing more to do: the run or the fault ended long enough ago for the drives and the record.
  bool finished(bool stop_wanted) const noexcept {
    const bool fault = supervisor_.mode() == mode::Mode::kFault;
    if (fault) return supervisor_.cycles_in_mode() >= kCyclesAfterFault;
    return (was_active_ || stop_wanted) && !active() && supervisor_.cycles_in_mode() >= kCyclesAfterStop;
  }

  const Settings<N, P>& settings() const noexcept { return settings_; }
  const strategy::Separated<N, P>& strategy() const noexcept { return strategy_; }
  const strategy::Decision<N>& decision() const noexcept { return *decision_; }
  const Command<N>& command() const noexcept { return command_; }
  const EventList& events() const noexcept { return events_; }
  mode::Mode mode() const noexcept { return supervisor_.mode(); }
  std::int32_t limits() const noexcept { return check_.limits; }  // bit set of those that act
  double time_s() const noexcept {
    return active() ? T_ * static_cast<double>(supervisor_.cycles_in_mode()) : 0.0;
  }  // active since
  protect::Reason trip() const noexcept { return trip_; }
  TripPlace trip_place() const noexcept { return trip_place_; }

 private:
  bool active() const noexcept { return supervisor_.mode() == mode::Mode::kActive; }

  double ContactForce(const Measurement<N>& measured) const noexcept {
    return strategy_.ContactForce(measured, !limits_.TooOld(measured.wrench_age));
  }

  protect::LimitCheck Watch(const Measurement<N>& measured, const CycleState& state) noexcept {
    if (!settings_.monitored) return {};
    const protect::LimitCheck check =
        watch_.CheckState(measured, state, supervisor_, limits_, source_, ContactForce(measured));
    const protect::LimitCheck rest = monitors_.AtRest(measured, supervisor_.mode() == mode::Mode::kReady);
    return check.trip != protect::Reason::kNone ? check : rest;
  }

  void Decide(const Measurement<N>& measured, const CycleState& state) noexcept {
    mode::Observation seen;
    seen.all_fresh = state.all_answered && measured.OldestAge() == 0;
    seen.drives_ready = measured.AllDrives(DriveState::kReady);
    seen.drives_enabled = measured.AllDrives(DriveState::kEnabled);
    seen.drives_braked = measured.AnyDrive(DriveState::kBraked);
    seen.tared = strategy_.tared() || measured.wrench_age == Measurement<N>::kNever;
    // The end of a run leads through ready to off, as the operator's stop does: drives that are left in ready get no
    // commands and brake, which looks like a fault.
    const bool over = active() ? time_s() >= settings_.duration_s : was_active_;
    seen.stop = state.stop_wanted || over;
    seen.trip = check_.trip != protect::Reason::kNone;
    const mode::Event event = supervisor_.Step(seen);
    if (event != mode::Event::kNone) Note(protect::Reason::kModeChange, -1, static_cast<double>(event));
    if (seen.trip && event == mode::Event::kTrip) NoteTrip();
    if (event == mode::Event::kStart) NoteForceZero(measured);
  }

  const strategy::Decision<N>& Control(const Measurement<N>& measured, const CycleState& state) noexcept {
    if (!active()) strategy_.Tare(measured);
    if (state.gap) strategy_.NoteGap();
    const auto workload = state.degrade ? strategy::Workload::kReduced : strategy::Workload::kFull;
    decision_ = state.hold && active() ? &strategy_.Repeat()
                                       : &strategy_.Step(measured, time_s(), active(), workload);
    return *decision_;
  }

  model::Vec<N> Protect(const strategy::Decision<N>& decision, const Measurement<N>& measured,
                        const CycleState& state) noexcept {
    if (!active()) monitors_.Reset(measured);
    if (supervisor_.Request() != DriveRequest::kEnable) return limits_.Release();
    const bool no_trip = check_.trip == protect::Reason::kNone;
    model::Vec<N> tau = limits_.Apply(decision.tau_law, measured.OldestAge(), check_);
    if (no_trip && active() && settings_.monitored) Monitor(decision, measured, state, tau);
    if (no_trip && active() && decision.force.lost && settings_.monitored) {
      check_ = {protect::Reason::kStretched, -1, decision.normal.D.norm(), check_.limits};
      tau = limits_.Release();
    }
    if (no_trip && check_.trip != protect::Reason::kNone) {  // found by the law or the gate itself
      mode::Observation seen;
      seen.trip = true;
      Note(protect::Reason::kModeChange, -1, static_cast<double>(supervisor_.Step(seen)));
      NoteTrip();
    }
    if (decision.force.speed_limited) check_.limits |= protect::LimitBit(protect::Reason::kNormalSpeed);
    if (decision.force.held) check_.limits |= protect::LimitBit(protect::Reason::kStretch);
    return tau;
  }

  /// Of the devices: a finding stops the arm in this cycle.
  void Monitor(const strategy::Decision<N>& decision, const Measurement<N>& measured, const CycleState& state,
               model::Vec<N>& tau) noexcept {
    const bool sensed = strategy_.tared() && !limits_.TooOld(measured.wrench_age);
    const protect::Observed<N> seen{.J = strategy_.jacobian(),
                                    .s = decision.s,
                                    .r = strategy_.observed(),
                                    .sent = tau,
                                    .energy = strategy_.kinetic_energy(),
                                    .felt = decision.felt,
                                    .force_known = decision.source == strategy::ForceSource::kKnown,
                                    .explainable = sensed && strategy_.law().smooth,
                                    .follows = strategy_.law().follows,
                                    .gap = state.gap || state.hold};
    const protect::LimitCheck found = monitors_.Moving(measured, seen);
    if (found.trip == protect::Reason::kNone || check_.trip != protect::Reason::kNone) return;
    check_ = {found.trip, found.joint, found.value, check_.limits};
    tau = limits_.Release();
  }

  void NoteDecision(const strategy::Decision<N>& decision) noexcept {
    if (decision.source != source_ && active()) {
      source_ = decision.source;
      Note(protect::Reason::kForceSourceChange, -1, static_cast<double>(source_));
    }
    if (decision.collision.joint >= 0)
      Note(protect::Reason::kCollision, decision.collision.joint, decision.collision.value);
    if (decision.force.held_now) Note(protect::Reason::kStretchHeld, -1, decision.normal.D.norm());
    if (decision.force.latched_now) Note(protect::Reason::kContact, -1, decision.f);
  }

  /// A sensor that touches nothing reads noise only. Otherwise it has a bias, or it does touch something.
  void NoteForceZero(const Measurement<N>& measured) noexcept {
    const double offset = strategy_.ForceZeroOffset();
    if (measured.wrench_age != Measurement<N>::kNever && offset > settings_.force_noise_N)
      Note(protect::Reason::kForceZero, -1, offset);
  }

  void NoteTrip() noexcept {
    trip_ = check_.trip;
    trip_place_ = {check_.joint, check_.value};
    Note(check_.trip, check_.joint, check_.value);
  }
  void Note(protect::Reason code, int joint, double value) noexcept {
    events_.Add({code, joint, value, supervisor_.mode(), source_});
  }

  static constexpr int kCyclesAfterStop = 5;    // for the drives to receive the request to close the brakes
  static constexpr int kCyclesAfterFault = 50;  // of recording after a fault

  const Settings<N, P> settings_;
  strategy::Separated<N, P> strategy_;
  protect::Limits<N> limits_;
  mode::Supervisor supervisor_;
  protect::Watch<N> watch_;
  protect::Monitors<N> monitors_;
  double T_;
  const strategy::Decision<N>* decision_ = nullptr;
  protect::LimitCheck check_;
  Command<N> command_;
  EventList events_;
  strategy::ForceSource source_ = strategy::ForceSource::kNone;
  protect::Reason trip_ = protect::Reason::kNone;
  TripPlace trip_place_;
  bool was_active_ = false;
};

// Not in the class, where they would be inline: whoever has them compiled elsewhere (extern template) does not compile them.
template <int N, int P>
Controller<N, P>::Controller(const Settings<N, P>& settings, reference::JointPath<N> path,
                             const strategy::ExternalLaw* external) noexcept
    : settings_(settings),
      strategy_(settings_, path, external),
      limits_(settings_.limits),
      supervisor_(settings_.start_wanted),
      watch_(settings_.period_s()),
      monitors_(settings_.monitors, settings_.period_s()),
      T_(settings_.period_s()) {}

template <int N, int P>
const Command<N>& Controller<N, P>::Step(const Measurement<N>& measured, const CycleState& state) noexcept {
  events_.Clear();
  check_ = Watch(measured, state);                                   // estimate
  Decide(measured, state);                                           // decide
  const strategy::Decision<N>& decision = Control(measured, state);  // control
  command_.torque = Protect(decision, measured, state);              // protect: the last gate
  command_.request = supervisor_.Request();
  NoteDecision(decision);
  was_active_ = was_active_ || active();
  return command_;
}

}  // namespace reed
