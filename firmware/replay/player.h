// A tape as the controller's world: its clock gives the readings of then, its bus the frames of then, and the operator's
// stop comes in the cycle in which it came. For one thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "reed/bus/codec/codec.h"
#include "reed/bus/transport/transport.h"
#include "reed/firmware/cycle/cycle_base.h"
#include "reed/firmware/snapshot/snapshot_ring.h"
#include "reed/firmware/tape/tape_reader.h"
#include "reed/firmware/tape/tape_writer.h"
#include "reed/rt/host_clock.h"

namespace reed {

/// Reads the tape one cycle ahead of the loop and writes what the loop has recorded.
class Player {
 public:
  /// @throws std::runtime_error when not even the first cycle can be replayed
  Player(tape::TapeReader& tape, std::int64_t first_cycle, telemetry::SnapshotRing& ring,
         tape::TapeWriter& out);

  /// The next reading of the clock: begin, then start and end of every cycle.
  rt::Instant Next() noexcept;
  rt::Instant last() const noexcept { return last_; }

  /// The cycle that is played.
  const telemetry::Snapshot& now() const noexcept { return now_; }
  /// The tape has no further cycle: what the loop does now is not written.
  bool ended() const noexcept { return ended_; }
  const std::atomic<bool>& stop() const noexcept { return stop_; }
  std::int64_t cycles() const noexcept { return cycles_; }
  /// What the loop has recorded up to here.
  void Drain();

 private:
  enum class Reading { kBegin, kStart, kEnd };
  void Load() noexcept;

  tape::TapeReader& tape_;
  std::int64_t first_cycle_;
  telemetry::SnapshotRing& ring_;
  tape::TapeWriter& out_;
  telemetry::Snapshot now_, ahead_;
  Reading reading_ = Reading::kBegin;
  rt::Instant last_{};
  std::int64_t cycles_ = 0;
  bool more_ = false, ended_ = false;
  std::atomic<bool> stop_{false};
};

/// CLOCK_MONOTONIC of then.
class TapeClock {
 public:
  explicit TapeClock(Player& player) noexcept : player_(player) {}
  rt::Instant ReadInstant() const noexcept { return player_.Next(); }
  std::int64_t NowNs() const noexcept { return player_.last().now_ns; }
  void SleepUntil(std::int64_t) const noexcept {}

 private:
  Player& player_;
};
static_assert(rt::InstantClock<TapeClock>);

/// The bus of then. What is sent goes nowhere but into the record.
class TapeTransport final : public bus::Transport {
 public:
  /// codec: finds the frames that only a reader of the protocol knows to be nobody's.
  TapeTransport(const Player& player, bus::ControllerCodec& codec) noexcept
      : player_(player), codec_(codec) {}

  /// One batch, as it came: frames that were read together have one time.
  int Receive(std::span<bus::Frame> out, int wanted, std::int64_t deadline_ns) noexcept override;
  int Send(std::span<const bus::Frame> frames) noexcept override { return static_cast<int>(frames.size()); }
  bool alive() const noexcept override { return player_.now().loop.bus_alive; }
  const bus::TransportCounters& counters() const noexcept override { return counters_; }
  std::string kind() const override { return "tape"; }
  std::string interface() const override { return "tape"; }

  /// Before each cycle.
  void Load();

 private:
  const Player& player_;
  std::vector<telemetry::RecordedFrame> frames_;
  std::size_t next_ = 0;
  bus::TransportCounters counters_;
  bus::ControllerCodec& codec_;
  std::int64_t unknown_ids_ = 0;
};

/// The real cycle, with the times that its phases took then.
class TapedCycle final : public CycleBase {
 public:
  TapedCycle(CycleBase& cycle, const Player& player, TapeTransport& bus) noexcept
      : cycle_(cycle), player_(player), bus_(bus) {}

  CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const CycleState& loop,
                  telemetry::Snapshot& snapshot) noexcept override;
  mode::Mode mode() const noexcept override { return cycle_.mode(); }
  protect::Reason trip() const noexcept override { return cycle_.trip(); }
  TripPlace trip_place() const noexcept override { return cycle_.trip_place(); }

 private:
  CycleBase& cycle_;
  const Player& player_;
  TapeTransport& bus_;
};

}  // namespace reed
