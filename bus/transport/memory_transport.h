// The two ends of a wire in memory, for controller and plant in one process: what one end sends the other
// receives, in order, as the bytes that any other bus carries. One thread; Receive never waits. In lockstep
// one side has nothing to do before the other has answered: an end can let the other side work first.
// RT: safe after construction.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reed/bus/transport/transport.h"

namespace reed::bus {

class MemoryTransport : public Transport {
 public:
  static constexpr std::size_t kCapacity = 256;

  /// `capacity`: frames on their way to this end; more are lost and counted, as in the queue of a socket.
  explicit MemoryTransport(std::size_t capacity = kCapacity) : capacity_(capacity) {
    inbox_.reserve(capacity);
  }
  MemoryTransport(const MemoryTransport&) = delete;
  MemoryTransport& operator=(const MemoryTransport&) = delete;

  /// Set-up only, as OnReceive().
  static void Join(MemoryTransport& a, MemoryTransport& b) noexcept;
  /// Called at the beginning of every Receive of this end. Must not throw.
  void OnReceive(std::function<void()> other_side) { other_side_ = std::move(other_side); }

  int Receive(std::span<Frame> out, int wanted, std::int64_t deadline_ns) noexcept override;
  int Send(std::span<const Frame> frames) noexcept override;
  bool alive() const noexcept override { return alive_; }
  const TransportCounters& counters() const noexcept override { return counters_; }
  std::string kind() const override { return "memory"; }
  std::string interface() const override { return "memory"; }

  /// From here on nothing passes and this end knows it.
  void Cut() noexcept { alive_ = false; }
  /// Sent by the other end, not yet received: whoever holds the wire may look, change and take off.
  std::vector<Frame>& inbox() noexcept { return inbox_; }

 private:
  std::size_t capacity_;
  std::vector<Frame> inbox_;
  MemoryTransport* peer_ = nullptr;
  std::function<void()> other_side_;
  TransportCounters counters_;
  bool alive_ = true;
};

/// Both ends, joined.
struct MemoryWire {
  MemoryWire() { MemoryTransport::Join(controller, plant); }
  MemoryTransport controller, plant;
};

}  // namespace reed::bus
