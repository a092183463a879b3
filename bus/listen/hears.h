// Who sends on the bus already, before this program sends. RT: set-up only.
#pragma once

#include <array>

#include "reed/bus/codec/codec.h"
#include "reed/bus/transport/transport.h"
#include "reed/rt/monotonic.h"

namespace reed::bus {

/// Three periods of the slowest rate, 50 Hz.
inline constexpr std::int64_t kListen_ns = 60'000'000;

/// Listens for kListen_ns; true as soon as a genuine frame of the protocol is of a kind that `wanted(kind)`.
template <typename Wanted>
bool Hears(Transport& transport, ControllerCodec& codec, Wanted&& wanted) {
  const std::int64_t end_ns = rt::NowNs() + kListen_ns;
  std::array<Frame, 32> frames{};
  while (rt::NowNs() < end_ns) {
    const int count = transport.Receive(frames, 1, end_ns);
    for (int i = 0; i < count; ++i) {
      const Decoded decoded = codec.Read(frames[static_cast<std::size_t>(i)]);
      if (IsGenuine(decoded) && wanted(decoded.kind)) return true;
    }
  }
  return false;
}

}  // namespace reed::bus
