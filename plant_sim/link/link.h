// What lies between controller and arm, in virtual time: the wire, and delay, jitter and loss in both directions. It says when a
// frame arrives; LinkTransport holds it back until then. RT: safe after the constructor.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "reed/bus/codec/messages.h"
#include "reed/bus/wire/wire.h"
#include "reed/config/plant/plant_config.h"
#include "reed/plant/link/path.h"
#include "reed/rt/spsc_ring.h"

namespace reed::plant {

/// What happened on the wire in one cycle.
struct WireTimes {
  double answers_s = 0.0;  // from the cycle's start until the last answer was through
  double command_s = 0.0;  // from its sending until the command was through
};

/// A command that the drives hear.
struct HeardCommand {
  bus::CommandMessage message;
  std::int64_t at_ns = 0;
};

class Link {
 public:
  Link(const LinkConfig& config, const TimingConfig& timing, int joints, std::int64_t seed);

  /// A cycle starts. When its joints hear the SYNC and sample.
  std::int64_t Start(std::int64_t cycle_ns, const bus::Frame& sync) noexcept;
  /// What the joints answer then.
  void Answer(std::span<const bus::Frame> frames) noexcept;
  /// The next frame that the controller gets in this cycle, if there is one.
  std::optional<bus::Frame> TakeForController() noexcept;
  /// The controller's command of this cycle.
  void Command(const bus::CommandMessage& message, const bus::Frame& frame) noexcept;

  /// The next command that the drives hear; nullptr: none is on its way, or the wire has not decided about it yet.
  const HeardCommand* NextCommand() noexcept { return heard_.Front(); }
  void PopCommand() noexcept { heard_.PopFront(); }

  bool has_wire() const noexcept { return has_wire_; }
  /// Of the last cycle that is over.
  const WireTimes& times() const noexcept { return over_; }
  double foreign_s() const noexcept { return 1e-9 * static_cast<double>(wire_.foreign_ns()); }
  /// Frames that found no room: the wire or a delay holds too many.
  std::int64_t dropped() const noexcept { return dropped_; }

 private:
  struct Underway {
    bus::Frame frame;
    std::int64_t arrives_ns = 0;
  };
  static constexpr std::size_t kRoom = 4096;

  void Offer(const bus::Frame& frame, std::int64_t ready_ns) noexcept;
  /// What was sent on the wire goes on to its receiver.
  void Deliver(const bus::Sent& sent) noexcept;
  void ToController(const bus::Frame& frame, std::int64_t sent_ns, bool of_this_cycle) noexcept;
  void ToDrives(const bus::CommandMessage& message, std::int64_t sent_ns) noexcept;

  bool has_wire_;
  std::int64_t period_ns_, receive_ns_, controller_ns_;
  bus::Wire wire_;
  Path commands_, measurements_;
  rt::SpscRing<Underway> underway_{kRoom};
  rt::SpscRing<bus::CommandMessage> on_wire_{kRoom};  // commands, in the order of their frames
  rt::SpscRing<HeardCommand> heard_{kRoom};
  std::int64_t cycle_ns_ = 0;     // start of the present cycle
  std::int64_t asked_ns_ = 0;     // its SYNC is heard
  std::int64_t complete_ns_ = 0;  // the controller has all its answers, or waits no longer
  int missing_ = 0;               // answers of this cycle that the controller has not got
  WireTimes now_, over_;
  std::int64_t dropped_ = 0;
};

}  // namespace reed::plant
