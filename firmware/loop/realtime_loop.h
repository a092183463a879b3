// The realtime loop, over any clock: the program's is CLOCK_MONOTONIC, that of a bench also knows the host's
// pauses (rt/host_clock.h), that of a replay has read its times before, the tests' moves by calls. RT: safe.
#pragma once

#include "reed/firmware/loop/stepper.h"
#include "reed/rt/clock.h"
#include "reed/rt/host_clock.h"

namespace reed {

template <rt::Clock Clock>
class RealtimeLoop {
 public:
  RealtimeLoop(Clock& clock, const LoopOptions& options, CycleBase& cycle,
               telemetry::SnapshotRing& ring) noexcept
      : clock_(clock),
        options_(options),
        period_ns_(rt::PeriodNs(options.rate_hz)),
        stepper_(options.first_cycle, cycle, ring),
        phases_(options.phases) {}

  LoopResult Run(const std::atomic<bool>& stop) noexcept {
    const rt::Instant begin = rt::ReadInstant(clock_);
    Silence silence(begin.own_ns);
    last_start_ns_ = begin.now_ns;
    point_ = {begin.now_ns + period_ns_, begin.own_ns + period_ns_};
    while (true) {
      clock_.SleepUntil(point_.now_ns);
      const rt::Instant start = rt::ReadInstant(clock_);
      state_.stop_wanted = stop.load(std::memory_order_relaxed);
      state_.gap = 2 * (start.now_ns - last_start_ns_) > 3 * period_ns_;
      last_start_ns_ = start.now_ns;
      // The receive phase ends on its own budget: what comes later is taken with the next cycle's frames.
      const std::int64_t rx_deadline_ns = start.now_ns + options_.phases.budget_ns[0];
      result_.status = stepper_.Step(point_, start, rx_deadline_ns, state_, result_);
      WatchPhases();
      const rt::Instant end = rt::ReadInstant(clock_);
      if (result_.status == CycleStatus::kRunning &&
          silence.TooLong(stepper_.snapshot().bus.frames_rx, end.own_ns))
        result_.status = CycleStatus::kBusLost;
      Schedule(start, end);
      stepper_.Close(end, result_);
      if (result_.status != CycleStatus::kRunning) break;
    }
    result_.wall_s = static_cast<double>(clock_.NowNs() - begin.now_ns) * 1e-9;
    return result_;
  }

 private:
  void WatchPhases() noexcept {
    const rt::PhaseCheck check = phases_.Check(stepper_.phase_times());
    telemetry::Timing& timing = stepper_.snapshot().timing;
    timing.rx_over = phases_.broken(rt::Phase::kReceive);
    timing.compute_over = phases_.broken(rt::Phase::kCompute);
    timing.tx_over = phases_.broken(rt::Phase::kTransmit);
    if (check.first)
      stepper_.NoteTime(protect::Reason::kPhaseBudget, static_cast<double>(check.phase), phases_.history());
    state_.hold = check.hold_next;
    state_.degrade = check.degrade_next;
    state_.phase_budget_exceeded = check.fault;
    state_.broken_in_row = phases_.in_row();
  }

  /// The next grid point, and what the missed ones mean for the next cycle.
  void Schedule(const rt::Instant& start, const rt::Instant& end) noexcept {
    const rt::OverrunDecision decision = rt::AfterCycle(
        options_.overrun, period_ns_, {point_.now_ns, start.now_ns, end.now_ns},
        {point_.own_ns, start.own_ns, end.own_ns}, state_.missed_in_row, options_.max_missed_in_row);
    const rt::Tick& next = decision.next;
    result_.missed += next.missed;
    result_.missed_host_paused += decision.missed_host_paused;
    if (next.missed > 0) {
      ++result_.overruns;
      stepper_.NoteTime(protect::Reason::kCyclesMissed, static_cast<double>(next.missed), phases_.history());
    }
    state_.missed_in_row = decision.missed_in_row;
    state_.missed_in_row_exceeded = decision.action == rt::CycleAction::kStop;
    state_.hold = state_.hold || decision.action == rt::CycleAction::kHold;
    point_ = {next.deadline_ns, end.own_ns + (next.deadline_ns - end.now_ns)};
  }

  Clock& clock_;
  LoopOptions options_;
  std::int64_t period_ns_;
  Stepper stepper_;
  rt::PhaseMonitor phases_;
  CycleState state_;
  rt::Instant point_{};  // grid point of the cycle that runs or comes next
  std::int64_t last_start_ns_ = 0;
  LoopResult result_;
};

}  // namespace reed
