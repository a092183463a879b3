#include "firmware/loop.h"

#include "firmware/rt/clock.h"
#include "firmware/rt/overrun.h"

namespace reed {
namespace {

constexpr std::int64_t kPatience_ns = 2'000'000'000;  // lockstep: silence this long is a lost bus
constexpr std::int64_t kLockstepTurn_ns =
    100'000'000;  // lockstep: one wait; frames that are lost cost this much once

/// One cycle with its snapshot; a full ring costs the snapshot, never the cycle.
class Stepper {
 public:
  Stepper(CycleBase& cycle, telemetry::SnapshotRing& ring) noexcept : cycle_(cycle), ring_(ring) {}

  CycleStatus Step(std::int64_t now_ns, std::int64_t wake_ns, std::int64_t rx_deadline_ns,
                   const LoopState& state, LoopResult& result) noexcept {
    telemetry::Snapshot* slot = ring_.Claim();
    telemetry::Snapshot& snapshot = slot != nullptr ? *slot : spare_;
    if (slot == nullptr) ++result.dropped;
    snapshot.ClearLists();
    snapshot.cycle = result.cycles;
    snapshot.time_ns = now_ns;
    snapshot.timing.wake_ns = static_cast<std::int32_t>(wake_ns);
    const CycleStatus status =
        cycle_.Run(static_cast<std::uint32_t>(result.cycles), rx_deadline_ns, state, snapshot);
    snapshot.timing.missed = result.missed;
    snapshot.timing.overruns = result.overruns;
    snapshot.timing.dropped = result.dropped;
    last_cycle_ns_ = snapshot.timing.cycle_ns;
    heard_ = snapshot.bus.frames_rx;
    if (slot != nullptr) ring_.Publish();
    ++result.cycles;
    return status;
  }
  std::int64_t last_cycle_ns() const noexcept { return last_cycle_ns_; }
  std::int64_t frames_heard() const noexcept { return heard_; }

 private:
  CycleBase& cycle_;
  telemetry::SnapshotRing& ring_;
  telemetry::Snapshot spare_;
  std::int64_t last_cycle_ns_ = 0;
  std::int64_t heard_ = 0;
};

/// Nothing heard for kPatience_ns although the controller asks every cycle.
class Silence {
 public:
  explicit Silence(std::int64_t now_ns) noexcept : last_ns_(now_ns) {}
  bool TooLong(std::int64_t frames_heard, std::int64_t now_ns) noexcept {
    if (frames_heard != frames_) {
      frames_ = frames_heard;
      last_ns_ = now_ns;
    }
    return now_ns - last_ns_ > kPatience_ns;
  }

 private:
  std::int64_t frames_ = 0;
  std::int64_t last_ns_;
};

}  // namespace

LoopResult RunWall(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                   const std::atomic<bool>& stop) noexcept {
  const rt::MonotonicClock clock;
  const std::int64_t period_ns = rt::PeriodNs(options.rate_hz);
  const std::int64_t rx_budget_ns = static_cast<std::int64_t>(options.rx_budget_us * 1e3);
  Stepper stepper(cycle, ring);
  LoopResult result;
  LoopState state;
  const std::int64_t start_ns = clock.NowNs();
  Silence silence(start_ns);
  std::int64_t deadline_ns = start_ns + period_ns;
  while (true) {
    clock.SleepUntil(deadline_ns);
    const std::int64_t now_ns = clock.NowNs();
    state.stop_wanted = stop.load(std::memory_order_relaxed);
    result.status = stepper.Step(now_ns, now_ns - deadline_ns, now_ns + rx_budget_ns, state, result);
    if (result.status != CycleStatus::kRunning) break;
    const std::int64_t end_ns = clock.NowNs();
    if (silence.TooLong(stepper.frames_heard(), end_ns)) {
      result.status = CycleStatus::kBusLost;
      break;
    }
    const rt::OverrunDecision next = rt::AfterCycle(rt::OverrunPolicy::kKeepGrid, deadline_ns, period_ns,
                                                    end_ns, state.missed_in_row, options.max_missed_in_row);
    if (next.next.missed > 0) ++result.overruns;
    result.missed += next.next.missed;
    state.missed_in_row = next.missed_in_row;
    state.missed_in_row_exceeded = next.action == rt::CycleAction::kStop;
    deadline_ns = next.next.deadline_ns;
  }
  result.wall_s = static_cast<double>(clock.NowNs() - start_ns) * 1e-9;
  return result;
}

LoopResult RunLockstep(const LoopOptions&, CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept {
  const rt::MonotonicClock clock;
  Stepper stepper(cycle, ring);
  LoopResult result;
  LoopState state;
  const std::int64_t start_ns = clock.NowNs();
  Silence silence(start_ns);
  do {
    const std::int64_t now_ns = clock.NowNs();
    state.stop_wanted = stop.load(std::memory_order_relaxed);
    result.status = stepper.Step(now_ns, 0, now_ns + kLockstepTurn_ns, state, result);
    if (silence.TooLong(stepper.frames_heard(), clock.NowNs())) result.status = CycleStatus::kBusLost;
  } while (result.status == CycleStatus::kRunning);
  result.wall_s = static_cast<double>(clock.NowNs() - start_ns) * 1e-9;
  return result;
}

}  // namespace reed
