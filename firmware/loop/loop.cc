#include "reed/firmware/loop/loop.h"

#include "reed/firmware/loop/realtime_loop.h"
#include "reed/rt/patience.h"

namespace reed {
namespace {

/// Lockstep: how long an answer may take. A machine or a debugger that holds the plant up for less changes no
/// figure of a run; answers that are lost cost this much once, and those after them only the second.
constexpr std::int64_t kFirstTurn_ns = 1'000'000'000;
constexpr std::int64_t kNextTurn_ns = 50'000'000;
constexpr std::int64_t kFullRing_ns = 200'000;  // lockstep: how often a full ring is looked at again

/// Waits while the ring is full; once the run shall stop, for a disk's patience in all and no longer.
class RoomInRing {
 public:
  void Await(telemetry::SnapshotRing& ring, const std::atomic<bool>& stop) noexcept {
    const rt::MonotonicClock clock;
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
  std::int64_t patient_until_ns_ = 0;
};

}  // namespace

LoopResult RunRealtime(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept {
  rt::MonotonicClock clock;
  return RealtimeLoop(clock, options, cycle, ring).Run(stop);
}

LoopResult RunOnPausingHost(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                            const std::atomic<bool>& stop, const rt::HostPauseWatch& watch) noexcept {
  rt::PausingClock clock(watch);
  return RealtimeLoop(clock, options, cycle, ring).Run(stop);
}

LoopResult RunLockstep(CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept {
  const rt::MonotonicClock clock;
  Stepper stepper(cycle, ring);
  LoopResult result;
  CycleState state;
  const std::int64_t start_ns = clock.NowNs();
  Silence silence(start_ns);
  RoomInRing room;
  bool lost = false;
  do {
    room.Await(ring, stop);
    const std::int64_t now_ns = clock.NowNs();
    state.stop_wanted = stop.load(std::memory_order_relaxed);
    const std::int64_t turn_ns = lost ? kNextTurn_ns : kFirstTurn_ns;
    result.status = stepper.Step(now_ns, 0, now_ns + turn_ns, state, result);
    lost = stepper.snapshot().timing.rx_ns >= turn_ns;
    if (result.status == CycleStatus::kRunning &&
        silence.TooLong(stepper.snapshot().bus.frames_rx, clock.NowNs()))
      result.status = CycleStatus::kBusLost;
    stepper.Close(result);
  } while (result.status == CycleStatus::kRunning);
  result.wall_s = static_cast<double>(clock.NowNs() - start_ns) * 1e-9;
  return result;
}

}  // namespace reed
