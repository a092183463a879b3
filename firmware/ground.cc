#include "firmware/ground.h"

#include <array>
#include <csignal>

#include "bus/messages.h"
#include "bus/wire_time.h"
#include "config/schema/bound.h"
#include "config/schema/config_error.h"
#include "firmware/rt/clock.h"

namespace reed {
namespace {

std::atomic<bool> stop_wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "written by a signal handler");

}  // namespace

void RefuseWireOverload(const Scenario& scenario) {
  const int joints = scenario.arm.dof();
  if (scenario.allow_wire_overload || bus::ScheduleFits(joints, scenario.timing.rate_hz)) return;
  throw ConfigError("timing.rate_hz: " + ToText(scenario.timing.rate_hz) + " Hz with " +
                    std::to_string(joints) + " joints loads a 1/5 Mbit/s wire to " +
                    std::to_string(static_cast<int>(100.0 * bus::WireLoad(joints, scenario.timing.rate_hz))) +
                    " %; allowed: up to " + std::to_string(static_cast<int>(bus::MaxRate_hz(joints))) +
                    " Hz, or scenario.allow_wire_overload = true");
}

void RefuseSecondController(bus::Transport& transport) {
  constexpr std::int64_t kListen_ns = 60'000'000;  // three periods of the slowest rate, 50 Hz
  const rt::MonotonicClock clock;
  const std::int64_t end_ns = clock.NowNs() + kListen_ns;
  bus::Decoder decoder;
  std::array<bus::Frame, 32> frames{};
  while (clock.NowNs() < end_ns) {
    const int count = transport.Receive(frames, 1, end_ns);
    for (int i = 0; i < count; ++i) {
      const bus::MessageKind kind = decoder.Decode(frames[static_cast<std::size_t>(i)]).kind;
      if (kind == bus::MessageKind::kSync || kind == bus::MessageKind::kCommand)
        throw BusError("another controller already sends on " + transport.kind() + ":" +
                       transport.interface() + "; stop it, or choose another bus with --bus");
    }
  }
}

const std::atomic<bool>& StopFlag() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_wanted.store(true, std::memory_order_relaxed); };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop_wanted;
}

}  // namespace reed
