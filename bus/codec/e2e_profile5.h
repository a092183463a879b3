// AUTOSAR E2E profile 5: proves that a frame is whole, is the one it claims to be, and follows its
// predecessor. CRC-16 CCITT-FALSE, low byte first, in bytes 0-1; 8-bit counter in byte 2. The CRC covers byte
// 2 to the end and then the 16-bit Data ID (low, high), which is known to both sides and never sent.
// RT: safe.
#pragma once

#include <cstdint>
#include <span>

namespace reed::bus {

enum class E2eState : std::uint8_t {
  kNone,           // nothing received yet
  kOk,             // counter followed its predecessor, or first frame
  kOkSomeLost,     // counter jumped, at most kMaxDeltaCounter: usable, some frames are missing
  kRepeated,       // counter did not move: the same frame again or a stuck sender
  kWrongSequence,  // counter jumped further: not usable, the next frame continues from here
  kCrcError,       // damaged, or another sender's frame: nothing in it is valid, not even its counter
};

/// A sender that paused for 20 cycles is still followed without losing a frame.
inline constexpr std::uint8_t kMaxDeltaCounter = 20;
inline constexpr std::size_t kE2eHeaderSize = 3;

/// CRC-16 CCITT-FALSE (polynomial 0x1021, first remainder `crc`, no reflection, no final xor).
std::uint16_t Crc16(std::span<const std::uint8_t> bytes, std::uint16_t crc = 0xFFFF) noexcept;

/// Writes CRC and `counter` into bytes 0-2 of `frame` (at least kE2eHeaderSize bytes).
void Protect(std::span<std::uint8_t> frame, std::uint16_t data_id, std::uint8_t counter) noexcept;

class E2eSender {
 public:
  /// Protects `frame` with the next counter.
  void Protect(std::span<std::uint8_t> frame, std::uint16_t data_id) noexcept {
    bus::Protect(frame, data_id, counter_++);
  }

 private:
  std::uint8_t counter_ = 0;
};

struct E2eCheck {
  E2eState state = E2eState::kNone;
  std::uint8_t lost = 0;  // frames that kOkSomeLost proves missing, else 0
};

class E2eReceiver {
 public:
  /// Checks one frame. Frames shorter than kE2eHeaderSize are kCrcError.
  E2eCheck Check(std::span<const std::uint8_t> frame, std::uint16_t data_id) noexcept;

 private:
  bool has_predecessor_ = false;
  std::uint8_t counter_ = 0;
};

}  // namespace reed::bus
