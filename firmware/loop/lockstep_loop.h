// The lockstep loop, over any clock: the next cycle starts when this one is done. RT: safe.
#pragma once

#include "reed/firmware/loop/stepper.h"
#include "reed/rt/clock.h"
#include "reed/rt/host_clock.h"
#include "reed/rt/patience.h"

namespace reed {

/// Waits while the ring is full; once the run shall stop, for a disk's patience in all and no longer.
class RoomInRing {
 public:
  void Await(telemetry::SnapshotRing& ring, const std::atomic<bool>& stop) noexcept {
    const rt::MonotonicClock clock;  // the reader's time, whatever the loop's is
    while (ring.Claim() == nullptr) {
      const std::int64_t now_ns = clock.NowNs();
      if (stop.load(std::memory_order_relaxed)) {
        if (patient_until_ns_ == 0) patient_until_ns_ = now_ns + rt::kDiskPatience_ns;
        if (now_ns > patient_until_ns_) return;
      }
      clock.SleepUntil(now_ns + kFullRing_ns);
    }
  }

 private:
  static constexpr std::int64_t kFullRing_ns = 200'000;  // how often a full ring is looked at again

  std::int64_t patient_until_ns_ = 0;
};

template <rt::Clock Clock>
class LockstepLoop {
 public:
  LockstepLoop(Clock& clock, std::int64_t first_cycle, CycleBase& cycle,
               telemetry::SnapshotRing& ring) noexcept
      : clock_(clock), ring_(ring), stepper_(first_cycle, cycle, ring) {}

  LoopResult Run(const std::atomic<bool>& stop) noexcept {
    const rt::Instant begin = rt::ReadInstant(clock_);
    Silence silence(begin.now_ns);
    LoopResult result;
    CycleState state;
    RoomInRing room;
    bool lost = false;
    do {
      room.Await(ring_, stop);
      const rt::Instant start = rt::ReadInstant(clock_);
      state.stop_wanted = stop.load(std::memory_order_relaxed);
      const std::int64_t turn_ns = lost ? kNextTurn_ns : kFirstTurn_ns;
      result.status = stepper_.Step(start, start, start.now_ns + turn_ns, state, result);
      lost = stepper_.snapshot().timing.rx_ns >= turn_ns;
      const rt::Instant end = rt::ReadInstant(clock_);
      if (result.status == CycleStatus::kRunning &&
          silence.TooLong(stepper_.snapshot().bus.frames_rx, end.now_ns))
        result.status = CycleStatus::kBusLost;
      stepper_.Close(end, result);
    } while (result.status == CycleStatus::kRunning);
    result.wall_s = static_cast<double>(clock_.NowNs() - begin.now_ns) * 1e-9;
    return result;
  }

 private:
  /// How long an answer may take. A machine or a debugger that holds the plant up for less changes no figure of
  /// a run; answers that are lost cost this much once, and those after them only the second.
  static constexpr std::int64_t kFirstTurn_ns = 1'000'000'000;
  static constexpr std::int64_t kNextTurn_ns = 50'000'000;

  Clock& clock_;
  telemetry::SnapshotRing& ring_;
  Stepper stepper_;
};

}  // namespace reed
