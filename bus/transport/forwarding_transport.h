// A transport in front of another one: what a derived class leaves alone goes through. RT: as the one behind.
#pragma once

#include <string>

#include "reed/bus/transport/transport.h"

namespace reed::bus {

class ForwardingTransport : public Transport {
 public:
  /// behind outlives it.
  explicit ForwardingTransport(Transport& behind) noexcept : behind_(behind) {}

  int Receive(std::span<Frame> out, int wanted, std::int64_t deadline_ns) noexcept override {
    return behind_.Receive(out, wanted, deadline_ns);
  }
  int Send(std::span<const Frame> frames) noexcept override { return behind_.Send(frames); }
  bool alive() const noexcept override { return behind_.alive(); }
  const TransportCounters& counters() const noexcept override { return behind_.counters(); }
  std::string kind() const override { return behind_.kind(); }
  std::string interface() const override { return behind_.interface(); }

 private:
  Transport& behind_;
};

}  // namespace reed::bus
