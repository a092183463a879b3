// An encoded message on its way to a sink. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace reed::telemetry {

/// One datagram on an Ethernet with room for LCM's header; every message stays below it.
inline constexpr std::size_t kMaxMessageBytes = 1400;

/// Encoded bytes, valid until the encoder's next call.
using Bytes = std::span<const std::uint8_t>;

}  // namespace reed::telemetry
