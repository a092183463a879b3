// One period of the arm, readable top to bottom. RT: safe, except the constructor.
#pragma once

#include <cmath>

#include "reed/core/safety/limits.h"
#include "reed/core/safety/supervisor.h"
#include "reed/core/separated.h"
#include "reed/firmware/arm_bus/arm_bus.h"
#include "reed/firmware/cycle/cycle_base.h"
#include "reed/firmware/cycle/fill.h"
#include "reed/firmware/planner/path_planner.h"

namespace reed {

template <int N, int P>
class Cycle final : public CycleBase {
 public:
  Cycle(const ControllerConfig& scenario, bus::Transport& transport, bool start_wanted)
      : arm_(scenario.arm),
        bus_(transport),
        strategy_(scenario, arm_, PlanPath(scenario)),
        limits_(LimitValuesFrom(scenario)),
        supervisor_(start_wanted),
        T_(1.0 / scenario.timing.rate_hz),
        duration_s_(scenario.duration_s) {}

  CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const LoopState& loop,
                  telemetry::Snapshot& snapshot) noexcept override {
    bus_.SendSync(cycle, snapshot);
    const bool all_answered = bus_.Receive(rx_deadline_ns, snapshot);  // receive
    const std::int64_t received = clock_.NowNs();

    const Measurement<N>& measured = bus_.measurement();
    CountIncomplete(measured);
    protect::Verdict verdict = Judge(measured, loop);  // estimate what it is worth
    const mode::Event event = supervisor_.Step(Observe(measured, all_answered, loop, verdict));  // decide
    if (event != mode::Event::kNone)
      Note(protect::Reason::kModeChange, -1, static_cast<double>(event), snapshot);
    if (verdict.trip != protect::Reason::kNone && event == mode::Event::kTrip)
      Note(verdict.trip, verdict.joint, verdict.value, snapshot);

    const strategy::Decision<N>& decision = Control(measured, loop);           // control
    const model::Vec<N> tau = Protect(decision, measured, verdict, snapshot);  // protect: the last word
    const std::int64_t computed = clock_.NowNs();

    bus_.SendCommand(supervisor_.Request(), tau, computed - snapshot.time_ns, snapshot);  // send
    const std::int64_t sent = clock_.NowNs();

    Record(measured, decision, tau, verdict, snapshot);  // record
    snapshot.timing.clock_stood = measured.clock_stood;
    snapshot.timing.rx_ns = rt::ShortNs(received - snapshot.time_ns);
    snapshot.timing.compute_ns = rt::ShortNs(computed - received);
    snapshot.timing.tx_ns = rt::ShortNs(sent - computed);
    snapshot.timing.cycle_ns = rt::ShortNs(sent - snapshot.time_ns);
    return Status(loop.stop_wanted);
  }

  mode::Mode mode() const noexcept override { return supervisor_.mode(); }
  protect::Reason trip() const noexcept override { return trip_; }
  TripPlace trip_place() const noexcept override { return trip_place_; }

 private:
  bool active() const noexcept { return supervisor_.mode() == mode::Mode::kActive; }
  double time_s() const noexcept { return active() ? T_ * supervisor_.cycles_in_mode() : 0.0; }

  reference::JointPath<N> PlanPath(const ControllerConfig& scenario) const {
    const auto pose_of = [this](const model::Vec<N>& q) {
      model::Kinematics<N> kin;
      model::ForwardKinematics<N, P>(arm_, q, model::Vec<N>::Zero(), kin);
      return kin;
    };
    return reference::PathPlanner<N>(pose_of, scenario).Plan();
  }

  protect::LimitValues<N> LimitValuesFrom(const ControllerConfig& scenario) const {
    protect::LimitValues<N> v;
    v.torque = scenario.limits.torque_scale * arm_.torque_limit;
    v.torque_step = scenario.limits.torque_rate_Nmps / scenario.timing.rate_hz;
    v.position_min = arm_.position_min.array() + scenario.limits.position_margin_rad / 2.0;
    v.position_max = arm_.position_max.array() - scenario.limits.position_margin_rad / 2.0;
    v.speed = scenario.limits.speed_scale * arm_.speed_limit;
    v.contact_force = scenario.limits.contact_force_N;
    v.hold_age = scenario.limits.hold_age_cycles;
    v.stop_age = scenario.limits.stop_age_cycles;
    return v;
  }

  /// Trips are looked for only while torque may flow: a still arm behind closed brakes is safe.
  protect::Verdict Judge(const Measurement<N>& measured, const LoopState& loop) const noexcept {
    using protect::Reason;
    if (measured.foreign_controller) return {Reason::kForeignController, -1, 0.0, 0};
    if (measured.surplus_joint >= 0) return {Reason::kSurplusJoint, measured.surplus_joint, 0.0, 0};
    if (cycles_incomplete_ * T_ > kPatience_s)
      return {Reason::kStaleMeasurement, measured.OldestJoint(), static_cast<double>(measured.OldestAge()),
              0};
    if (supervisor_.Request() != bus::DriveRequest::kEnable) return {};
    // What was missed while the arm's own clock stood still did it no harm. Real drives never say so; a
    // simulated arm may with its next answer, and one that stays silent stops by its age.
    const bool told = !bus_.simulated() || measured.YoungestAge() == 0;
    if (active() && loop.missed_in_row_exceeded && told && !measured.clock_stood)
      return {Reason::kMissedCycles, -1, static_cast<double>(loop.missed_in_row), 0};
    if (active() && loop.phase_budget_exceeded)
      return {Reason::kPhaseBudgetInRow, -1, static_cast<double>(loop.broken_in_row), 0};
    for (int i = 0; i < N; ++i) {
      const bus::DriveState state = measured.drive[static_cast<std::size_t>(i)];
      if (!MayBe(state)) return {Reason::kDriveFault, i, static_cast<double>(state), 0};
    }
    const bool force_told = !limits_.TooOld(measured.wrench_age);
    // A law that tracks the measured force presses blindly without it; one that can do without says so by its
    // source.
    if (active() && source_ == strategy::ForceSource::kKnown && !force_told)
      return {Reason::kStaleWrench, -1, static_cast<double>(measured.wrench_age), 0};
    const double force = force_told ? measured.force.norm() : 0.0;
    return limits_.Judge(measured.theta, measured.theta_dot, force, measured.OldestAge(),
                         measured.OldestJoint());
  }

  /// An arm that shall start and of which some joints have never been heard will not start by waiting.
  void CountIncomplete(const Measurement<N>& measured) noexcept {
    const bool waits = supervisor_.mode() == mode::Mode::kOff && supervisor_.start_wanted();
    const bool incomplete =
        measured.OldestAge() == Measurement<N>::kNever && measured.YoungestAge() < Measurement<N>::kNever;
    cycles_incomplete_ = waits && incomplete ? cycles_incomplete_ + 1 : 0;
  }

  /// Of a drive that is asked to be enabled. The others already have torque while one of them takes its time;
  /// one that has braked asks for a new start (supervisor.h).
  bool MayBe(bus::DriveState state) const noexcept {
    if (active() || supervisor_.cycles_enabling() * T_ > kTimeToEnable_s)
      return state == bus::DriveState::kEnabled;
    return state != bus::DriveState::kFault;
  }

  mode::Observation Observe(const Measurement<N>& measured, bool all_answered, const LoopState& loop,
                            const protect::Verdict& verdict) const noexcept {
    mode::Observation seen;
    seen.all_fresh = all_answered && measured.OldestAge() == 0;
    seen.drives_ready = measured.AllDrives(bus::DriveState::kReady);
    seen.drives_enabled = measured.AllDrives(bus::DriveState::kEnabled);
    seen.drives_braked = measured.AnyDrive(bus::DriveState::kBraked);
    seen.settled = strategy_.settled() || measured.wrench_age == Measurement<N>::kNever;
    // The end of a run leads through ready to off, as the operator's stop does: drives that are left in ready
    // brake for want of commands, which looks like a fault.
    const bool over = active() ? time_s() >= duration_s_ : was_active_;
    seen.stop = loop.stop_wanted || over;
    seen.trip = verdict.trip != protect::Reason::kNone;
    return seen;
  }

  const strategy::Decision<N>& Control(const Measurement<N>& measured, const LoopState& loop) noexcept {
    if (!active()) strategy_.Settle(measured);
    if (loop.gap) strategy_.NoteGap();
    if (loop.hold && active()) return strategy_.Repeat();
    return strategy_.Step(measured, time_s(), active(),
                          loop.degrade ? strategy::Effort::kReduced : strategy::Effort::kFull);
  }

  model::Vec<N> Protect(const strategy::Decision<N>& decision, const Measurement<N>& measured,
                        protect::Verdict& verdict, telemetry::Snapshot& snapshot) noexcept {
    if (supervisor_.Request() != bus::DriveRequest::kEnable) return limits_.Release();
    const bool sound = verdict.trip == protect::Reason::kNone;
    const model::Vec<N> tau = limits_.Apply(decision.tau_law, measured.OldestAge(), verdict);
    if (sound &&
        verdict.trip != protect::Reason::kNone) {  // found by the gate itself: the law's torque is not finite
      mode::Observation seen;
      seen.trip = true;
      Note(protect::Reason::kModeChange, -1, static_cast<double>(supervisor_.Step(seen)), snapshot);
      Note(verdict.trip, verdict.joint, verdict.value, snapshot);
    }
    if (decision.force.speed_limited) verdict.limits |= protect::LimitBit(protect::Reason::kNormalSpeed);
    return tau;
  }

  void Note(protect::Reason reason, int joint, double value, telemetry::Snapshot& snapshot) noexcept {
    if (protect::IsTrip(reason)) {
      trip_ = reason;
      trip_place_ = {joint, value};
    }
    telemetry::Event event;
    event.mode = static_cast<std::int8_t>(supervisor_.mode());
    event.force_source = static_cast<std::int8_t>(source_);
    event.code = static_cast<std::int32_t>(reason);
    event.joint = joint;
    event.value = value;
    snapshot.AddEvent(event);
  }

  void Record(const Measurement<N>& measured, const strategy::Decision<N>& decision, const model::Vec<N>& tau,
              const protect::Verdict& verdict, telemetry::Snapshot& snapshot) noexcept {
    if (decision.source != source_ && active()) {
      source_ = decision.source;
      Note(protect::Reason::kForceSourceChange, -1, static_cast<double>(source_), snapshot);
    }
    if (decision.collision.joint >= 0)
      Note(protect::Reason::kCollision, decision.collision.joint, decision.collision.value, snapshot);
    if (decision.force.latched_now) Note(protect::Reason::kContact, -1, decision.f, snapshot);
    snapshot.dof = N;
    snapshot.num_parameters = arm_.num_parameters;
    telemetry::FillMeasured(measured, snapshot.measured);
    telemetry::FillControl(decision, strategy_, snapshot.control);
    telemetry::FillAdaptation(strategy_.adaptive(), snapshot.adaptation);
    telemetry::FillBus(bus_.transport_counters(), bus_.decode_counters(), bus_.late_frames(), snapshot.bus);
    telemetry::Fill(snapshot.control.tau, tau);
    snapshot.control.t_s = time_s();
    snapshot.control.mode = static_cast<std::int8_t>(supervisor_.mode());
    snapshot.control.limits = verdict.limits;
  }

  CycleStatus Status(bool stop_wanted) noexcept {
    if (!bus_.alive()) return CycleStatus::kBusLost;
    if (supervisor_.mode() == mode::Mode::kFault && supervisor_.cycles_in_mode() >= kCyclesAfterFault)
      return CycleStatus::kFinished;
    was_active_ = was_active_ || active();
    const bool ended = (was_active_ || stop_wanted) && !active() && supervisor_.mode() != mode::Mode::kFault;
    if (ended && supervisor_.cycles_in_mode() >= kCyclesAfterStop) return CycleStatus::kFinished;
    return CycleStatus::kRunning;
  }

  static constexpr double kPatience_s = 2.0;
  static constexpr double kTimeToEnable_s = 1.0;  // a brake takes some 0.1 s to open
  static constexpr int kCyclesAfterStop = 5;      // the drives hear that they shall close the brakes
  static constexpr int kCyclesAfterFault = 50;    // of recording after a fault

  rt::MonotonicClock clock_;
  model::ArmModel<N, P> arm_;
  ArmBus<N> bus_;
  strategy::Separated<N, P> strategy_;
  protect::Limits<N> limits_;
  mode::Supervisor supervisor_;
  double T_;
  double duration_s_;
  strategy::ForceSource source_ = strategy::ForceSource::kNone;
  protect::Reason trip_ = protect::Reason::kNone;
  TripPlace trip_place_;
  int cycles_incomplete_ = 0;  // off, although an arm is heard
  bool was_active_ = false;
};

}  // namespace reed
