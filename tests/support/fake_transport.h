// Two transports joined in memory, for tests at the frame level: what one end sends the other receives, in
// order. One thread; Receive never waits. Frames on their way can be looked at, changed and taken off.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>

#include "reed/bus/transport/transport.h"

namespace reed::test {

class FakeTransport final : public bus::Transport {
 public:
  int Receive(std::span<bus::Frame> out, int /*wanted*/, std::int64_t deadline_ns) noexcept override {
    last_deadline_ns = deadline_ns;
    const std::size_t count = std::min(out.size(), inbox.size());
    std::copy_n(inbox.begin(), count, out.begin());
    inbox.erase(inbox.begin(), inbox.begin() + static_cast<std::ptrdiff_t>(count));
    counters_.frames_rx += count;
    return static_cast<int>(count);
  }

  int Send(std::span<const bus::Frame> frames) noexcept override {
    if (!alive_) return 0;
    peer->inbox.insert(peer->inbox.end(), frames.begin(), frames.end());
    counters_.frames_tx += frames.size();
    ++batches;
    return static_cast<int>(frames.size());
  }

  bool alive() const noexcept override { return alive_; }
  const bus::TransportCounters& counters() const noexcept override { return counters_; }
  std::string kind() const override { return kind_name; }
  std::string interface() const override { return interface_name; }

  void Cut() { alive_ = false; }

  std::deque<bus::Frame> inbox;  // sent by the peer, not yet received
  FakeTransport* peer = nullptr;
  int batches = 0;  // calls of Send
  std::string kind_name = "fake", interface_name = "memory";
  std::int64_t last_deadline_ns = 0;

 private:
  bus::TransportCounters counters_;
  bool alive_ = true;
};

/// The two ends of one wire.
struct FakeWire {
  FakeWire() {
    controller.peer = &plant;
    plant.peer = &controller;
  }
  FakeWire(const FakeWire&) = delete;
  FakeWire& operator=(const FakeWire&) = delete;

  FakeTransport controller;
  FakeTransport plant;
};

}  // namespace reed::test
