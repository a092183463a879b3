// One turn of either loop: a cycle with its snapshot, and the silence after which a bus is lost. RT: safe.
#pragma once

#include "reed/firmware/loop/loop.h"
#include "reed/rt/clock.h"
#include "reed/rt/host_clock.h"

namespace reed {

/// No frame for so long, although SYNC goes out every cycle: the bus is lost.
inline constexpr std::int64_t kPatience_ns = 2'000'000'000;

/// One cycle with its snapshot; a full ring drops the snapshot and never delays the cycle.
class Stepper {
 public:
  Stepper(std::int64_t first_cycle, CycleBase& cycle, telemetry::SnapshotRing& ring) noexcept
      : first_cycle_(first_cycle), cycle_(cycle), ring_(ring) {}

  /// Runs one cycle, which is due at `point` and begins at `start`. The loop may write to its snapshot until
  /// Close().
  CycleStatus Step(const rt::Instant& point, const rt::Instant& start, std::int64_t rx_deadline_ns,
                   const CycleState& state, LoopResult& result) noexcept {
    slot_ = ring_.Claim();
    if (slot_ == nullptr) ++result.dropped;
    telemetry::Snapshot& now = snapshot();
    now.ClearLists();
    now.cycle = first_cycle_ + result.cycles;
    now.time_ns = start.now_ns;
    now.timing = {};
    now.timing.wake_ns = rt::ShortNs(start.now_ns - point.now_ns);
    NoteLoop(point, start, state, now.loop);
    const CycleStatus status = cycle_.Run(static_cast<std::uint32_t>(now.cycle), rx_deadline_ns, state, now);
    now.loop.bus_alive = status != CycleStatus::kBusLost;
    ++result.cycles;
    return status;
  }

  telemetry::Snapshot& snapshot() noexcept { return slot_ != nullptr ? *slot_ : spare_; }

  rt::PhaseTimes phase_times() noexcept {
    const telemetry::Timing& t = snapshot().timing;
    return {t.rx_ns, t.compute_ns, t.tx_ns};
  }

  /// News about time, with the phase times of the last cycles.
  void NoteTime(protect::Reason reason, double value, const rt::PhaseHistory& history) noexcept {
    telemetry::Snapshot& now = snapshot();
    telemetry::Event event;
    event.mode = now.control.mode;
    event.force_source = now.control.force_source;
    event.code = static_cast<std::int32_t>(reason);
    event.value = value;
    event.about_time = true;
    now.phase_history = history;
    now.AddEvent(event);
  }

  /// end: read behind the cycle.
  void Close(const rt::Instant& end, const LoopResult& result) noexcept {
    telemetry::Snapshot& now = snapshot();
    now.loop.end_ns = end.now_ns;
    now.loop.end_own_ns = end.own_ns;
    now.loop.status = static_cast<std::int8_t>(result.status);
    now.timing.missed = result.missed;
    now.timing.missed_host_paused = result.missed_host_paused;
    now.timing.overruns = result.overruns;
    now.timing.dropped = result.dropped;
    if (slot_ != nullptr) ring_.Publish();
    slot_ = nullptr;
  }

 private:
  static void NoteLoop(const rt::Instant& point, const rt::Instant& start, const CycleState& state,
                       telemetry::LoopRecord& out) noexcept {
    out.point_ns = point.now_ns;
    out.point_own_ns = point.own_ns;
    out.start_own_ns = start.own_ns;
    out.missed_in_row = state.missed_in_row;
    out.broken_in_row = state.broken_in_row;
    out.stop_wanted = state.stop_wanted;
    out.missed_in_row_exceeded = state.missed_in_row_exceeded;
    out.phase_budget_exceeded = state.phase_budget_exceeded;
    out.gap = state.gap;
    out.hold = state.hold;
    out.degrade = state.degrade;
  }

  std::int64_t first_cycle_;
  CycleBase& cycle_;
  telemetry::SnapshotRing& ring_;
  telemetry::Snapshot* slot_ = nullptr;
  telemetry::Snapshot spare_;
};

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

}  // namespace reed
