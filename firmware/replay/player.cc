#include "player.h"

#include <algorithm>
#include <stdexcept>

#include "reed/rt/grid.h"

namespace reed {

Player::Player(tape::TapeReader& tape, std::int64_t first_cycle, telemetry::SnapshotRing& ring,
               tape::TapeWriter& out)
    : tape_(tape), first_cycle_(first_cycle), ring_(ring), out_(out) {
  more_ = tape_.Next(ahead_);
  if (!more_ || ahead_.cycle != first_cycle_ || ahead_.frames_omitted > 0)
    throw std::runtime_error(
        "its first cycle is missing or not whole: without it the controller's state is not known");
}

/// A cycle that is missing, or some of whose frames are, ends what can be replayed.
void Player::Load() noexcept {
  if (!more_) {
    ended_ = true;
    return;
  }
  now_ = ahead_;
  more_ = tape_.Next(ahead_) && ahead_.cycle == now_.cycle + 1 && ahead_.frames_omitted == 0;
  stop_.store(now_.loop.stop_wanted, std::memory_order_relaxed);
  ++cycles_;
}

rt::Instant Player::Next() noexcept {
  switch (reading_) {
    case Reading::kBegin: {  // one period before the first grid point; in lockstep nothing depends on it
      const std::int64_t period_ns = rt::PeriodNs(tape_.header().rate_hz);
      reading_ = Reading::kStart;
      return last_ = {ahead_.loop.point_ns - period_ns, ahead_.loop.point_own_ns - period_ns};
    }
    case Reading::kStart:
      Drain();
      Load();
      reading_ = Reading::kEnd;
      return last_ = ended_ ? last_ : rt::Instant{now_.time_ns, now_.loop.start_own_ns};
    case Reading::kEnd:
      reading_ = Reading::kStart;
      return last_ = ended_ ? last_ : rt::Instant{now_.loop.end_ns, now_.loop.end_own_ns};
  }
  return last_;
}

void Player::Drain() {
  for (const telemetry::Snapshot* one = ring_.Front(); one != nullptr; one = ring_.Front()) {
    if (one->cycle < first_cycle_ + cycles_) out_.Write(*one);
    ring_.PopFront();
  }
}

void TapeTransport::Load() {
  frames_.clear();
  next_ = 0;
  player_.now().ForEachFrame([this](const telemetry::RecordedFrame& one) {
    if (one.direction != telemetry::Direction::kReceived) return;
    frames_.push_back(one);
    if (codec_.Read(one.frame).reject == bus::Reject::kUnknownId) ++unknown_ids_;
  });
  const telemetry::BusCounters& then = player_.now().bus;
  const auto counter = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  counters_.frames_rx = counter(then.frames_rx);
  counters_.frames_tx = counter(then.frames_tx);
  counters_.foreign_ids = counter(std::max<std::int64_t>(then.unknown_id - unknown_ids_, 0));
  counters_.malformed = counter(then.malformed);
  counters_.error_frames = counter(then.error_frames);
  counters_.overflowed = counter(then.overflowed);
  counters_.tx_refused = counter(then.tx_refused);
}

int TapeTransport::Receive(std::span<bus::Frame> out, int, std::int64_t) noexcept {
  std::size_t count = 0;
  while (next_ < frames_.size() && count < out.size() &&
         (count == 0 || frames_[next_].offset_ns == frames_[next_ - 1].offset_ns))
    out[count++] = frames_[next_++].frame;
  return static_cast<int>(count);
}

CycleStatus TapedCycle::Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const CycleState& loop,
                            telemetry::Snapshot& snapshot) noexcept {
  if (player_.ended()) return CycleStatus::kFinished;
  bus_.Load();
  const CycleStatus status = cycle_.Run(cycle, rx_deadline_ns, loop, snapshot);
  const telemetry::Timing& then = player_.now().timing;
  snapshot.timing.rx_ns = then.rx_ns;
  snapshot.timing.compute_ns = then.compute_ns;
  snapshot.timing.tx_ns = then.tx_ns;
  snapshot.timing.cycle_ns = then.cycle_ns;
  snapshot.TakeFrameTimes(player_.now());
  return status;
}

}  // namespace reed
