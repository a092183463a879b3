// One CAN FD frame as python-can's udp_multicast interface writes it: a msgpack map of 11 keys (timestamp,
// arbitration_id, is_extended_id, is_remote_frame, is_error_frame, channel, dlc, data, is_fd, bitrate_switch,
// error_state_indicator). No heap. RT: safe.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "reed/bus/frame/frame.h"
#include "reed/bus/transport/incoming.h"

namespace reed::bus {

inline constexpr std::size_t kMaxPackedFrame = 256;  // 231 bytes for a 64-byte payload

/// Writes `frame` and returns the bytes used. `timestamp_s`: Unix time. Pre: frame.size <= 64.
std::size_t PackFrame(const Frame& frame, double timestamp_s,
                      std::span<std::uint8_t, kMaxPackedFrame> out) noexcept;

/// kFrame, kErrorFrame or kMalformed. Accepts every integer, float, string and binary width of msgpack and
/// keys in any order.
Incoming UnpackFrame(std::span<const std::uint8_t> bytes, Frame& out) noexcept;

}  // namespace reed::bus
