// A wire in memory for tests at the frame level, with a name of choice: what passes can be looked at, changed
// and taken off.
#pragma once

#include <cstdint>
#include <string>

#include "reed/bus/transport/memory_transport.h"

namespace reed::test {

class FakeTransport final : public bus::MemoryTransport {
 public:
  FakeTransport() : MemoryTransport(8192) {}  // tests of floods

  int Receive(std::span<bus::Frame> out, int wanted, std::int64_t deadline_ns) noexcept override {
    last_deadline_ns = deadline_ns;
    return MemoryTransport::Receive(out, wanted, deadline_ns);
  }
  int Send(std::span<const bus::Frame> frames) noexcept override {
    ++batches;
    return MemoryTransport::Send(frames);
  }
  std::string kind() const override { return kind_name; }
  std::string interface() const override { return interface_name; }

  int batches = 0;  // calls of Send
  std::string kind_name = "fake", interface_name = "memory";
  std::int64_t last_deadline_ns = 0;
};

/// The two ends of one wire.
struct FakeWire {
  FakeWire() { bus::MemoryTransport::Join(controller, plant); }
  FakeTransport controller, plant;
};

}  // namespace reed::test
