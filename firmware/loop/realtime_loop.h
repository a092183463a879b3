// The loop on the clock, over any clock: the program's is CLOCK_MONOTONIC, the tests' moves when it is told
// to. RT: safe.
#pragma once

#include "reed/firmware/loop/stepper.h"
#include "reed/rt/clock.h"

namespace reed {

template <rt::Clock Clock>
class WallLoop {
 public:
  WallLoop(Clock& clock, const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring) noexcept
      : clock_(clock),
        options_(options),
        period_ns_(rt::PeriodNs(options.rate_hz)),
        stepper_(cycle, ring),
        phases_(options.phases) {}

  LoopResult Run(const std::atomic<bool>& stop) noexcept {
    const std::int64_t start_ns = clock_.NowNs();
    Silence silence(start_ns);
    last_start_ns_ = start_ns;
    std::int64_t deadline_ns = start_ns + period_ns_;
    while (true) {
      clock_.SleepUntil(deadline_ns);
      const std::int64_t now_ns = clock_.NowNs();
      state_.stop_wanted = stop.load(std::memory_order_relaxed);
      state_.gap = 2 * (now_ns - last_start_ns_) > 3 * period_ns_;
      last_start_ns_ = now_ns;
      // The receive phase ends on its own budget: what comes later is taken with the next cycle's frames.
      const std::int64_t rx_deadline_ns = now_ns + options_.phases.budget_ns[0];
      result_.status = stepper_.Step(now_ns, now_ns - deadline_ns, rx_deadline_ns, state_, result_);
      WatchPhases();
      const std::int64_t end_ns = clock_.NowNs();
      if (result_.status == CycleStatus::kRunning &&
          silence.TooLong(stepper_.snapshot().bus.frames_rx, end_ns))
        result_.status = CycleStatus::kBusLost;
      deadline_ns = NextDeadline(deadline_ns, now_ns, end_ns);
      stepper_.Close(result_);
      if (result_.status != CycleStatus::kRunning) break;
    }
    result_.wall_s = static_cast<double>(clock_.NowNs() - start_ns) * 1e-9;
    return result_;
  }

 private:
  void WatchPhases() noexcept {
    const rt::PhaseVerdict verdict = phases_.Check(stepper_.phase_times());
    telemetry::Timing& timing = stepper_.snapshot().timing;
    timing.rx_over = phases_.broken(rt::Phase::kReceive);
    timing.compute_over = phases_.broken(rt::Phase::kCompute);
    timing.tx_over = phases_.broken(rt::Phase::kTransmit);
    if (verdict.first)
      stepper_.NoteTime(protect::Reason::kPhaseBudget, static_cast<double>(verdict.phase), phases_.history());
    state_.hold = verdict.hold_next;
    state_.degrade = verdict.degrade_next;
    state_.phase_budget_exceeded = verdict.fault;
    state_.broken_in_row = phases_.in_row();
  }

  std::int64_t NextDeadline(std::int64_t deadline_ns, std::int64_t start_ns, std::int64_t end_ns) noexcept {
    // A mark says that the arm's clock stood still between the last answer and this one: what the last cycle
    // missed behind its answer and this one before it was nothing to the arm, and the row goes on without it.
    const bool stood = stepper_.snapshot().timing.clock_stood;
    const int row = stood ? row_before_ : state_.missed_in_row;
    const rt::OverrunDecision next = rt::AfterCycle(options_.overrun, deadline_ns, period_ns_, start_ns,
                                                    end_ns, row, options_.max_missed_in_row);
    result_.missed += next.next.missed;
    if (next.next.missed > 0) {
      ++result_.overruns;
      stepper_.NoteTime(protect::Reason::kStall, static_cast<double>(next.next.missed), phases_.history());
    }
    const bool ended = next.missed_in_row == 0;
    row_before_ = ended ? 0 : row;
    state_.missed_in_row = stood && !ended ? row : next.missed_in_row;
    state_.missed_in_row_exceeded = next.action == rt::CycleAction::kStop && !stood;
    state_.hold = state_.hold || next.action == rt::CycleAction::kHold;
    return next.next.deadline_ns;
  }

  Clock& clock_;
  LoopOptions options_;
  std::int64_t period_ns_;
  Stepper stepper_;
  rt::PhaseMonitor phases_;
  CycleState state_;
  std::int64_t last_start_ns_ = 0;
  int row_before_ = 0;  // of missed points, without those of the last cycle
  LoopResult result_;
};

}  // namespace reed
