// The plant's plug into the bus: frames to SYNC and commands, measurements to one batch of frames. RT: safe.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "reed/bus/codec/codec.h"
#include "reed/bus/transport/transport.h"
#include "reed/plant/endpoint/robot.h"

namespace reed::plant {

/// One thing that a controller wants.
struct Incoming {
  enum class Kind : std::uint8_t { kSync, kCommand } kind = Kind::kSync;
  bool new_controller = false;  // kSync: cycle numbers repeat, go backwards or leap, or it is the first ever
  std::int64_t count = 0;  // kSync: the cycle's number, which goes on where that of the frame starts over
  bus::SyncMessage sync;
  bus::CommandMessage command;
};

class BusPort {
 public:
  /// codec: of the drives; nullptr: of bus/reed.dbc. transport outlives the port.
  BusPort(bus::Transport& transport, std::unique_ptr<bus::ArmCodec> codec);

  /// Waits for at least one frame until `deadline_ns` (CLOCK_MONOTONIC) and returns what the frames say, in
  /// order; valid until the next call. Frames that may not be used, and those of nobody's concern here, are
  /// left out and counted.
  std::span<const Incoming> Receive(std::int64_t deadline_ns) noexcept;

  /// One state frame per joint, then the wrench unless it is lost, in one Send.
  void Answer(std::uint32_t cycle, const Measurement& measurement) noexcept;

  /// Frames that the last Receive took off the bus, of use or not.
  int received() const noexcept { return received_; }
  bool alive() const noexcept { return transport_.alive(); }
  std::uint64_t rejected() const noexcept { return rejected_; }
  /// Somebody else has answered as joint or wrist.
  bool another_arm() const noexcept { return another_arm_; }

 private:
  static constexpr std::size_t kBatch = 64;
  /// So many SYNCs may be lost on the way, 1000 s at 1 kHz; a number further ahead is another controller's.
  static constexpr std::uint32_t kLongestGap = 1'000'000;

  std::optional<Incoming> Read(const bus::Frame& frame, const bus::Decoded& decoded) noexcept;
  std::optional<Incoming> ReadSync(const bus::Frame& frame, const bus::Decoded& decoded) noexcept;

  bus::Transport& transport_;
  std::unique_ptr<bus::ArmCodec> codec_;
  std::array<bus::Frame, kBatch> frames_;
  std::array<Incoming, 2 * kBatch> incoming_;              // a frame may say two things
  std::optional<std::uint32_t> first_cycle_, last_cycle_;  // of the present controller
  int received_ = 0;
  std::int64_t count_ = 0;
  std::uint64_t rejected_ = 0;
  bool another_arm_ = false;
};

}  // namespace reed::plant
