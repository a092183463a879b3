#include "reed/bus/wire/frame_bits.h"

#include <array>

namespace reed::bus {
namespace {

/// Counts bits as they go out, each fifth equal one followed by its opposite, but not behind the last one of all: there a stuff
/// bit of the checksum comes anyway.
class Stuffer {
 public:
  void Put(std::uint32_t value, int bits) noexcept {
    for (int k = bits - 1; k >= 0; --k) Put(((value >> k) & 1U) != 0);
  }
  /// What comes from here on is of the other bit rate.
  int Split() noexcept {
    const int before = count_;
    count_ = 0;
    return before;
  }

 private:
  void Put(bool bit) noexcept {
    if (run_ == 5) {
      ++count_;  // the stuff bit begins the next run
      last_ = !last_;
      run_ = 1;
    }
    ++count_;
    run_ = bit == last_ ? run_ + 1 : 1;
    last_ = bit;
  }

  int count_ = 0, run_ = 0;
  bool last_ = true;  // the idle wire; it is followed by the start bit, its opposite
};

constexpr std::uint32_t DataLengthCode(int size) noexcept {
  constexpr std::array kLong = {12, 16, 20, 24, 32, 48, 64};
  if (size <= 8) return static_cast<std::uint32_t>(size);
  std::uint32_t code = 9;
  for (const int one : kLong) {
    if (size <= one) return code;
    ++code;
  }
  return 15;
}

}  // namespace

FrameBits BitsOf(const Frame& frame) noexcept {
  constexpr int kEnd = 1 + 1 + 1 + 7 + kIntermissionBits;  // CRC delimiter, ACK, its delimiter, end of frame
  Stuffer bits;
  bits.Put(0, 1);  // start of frame
  if (frame.extended) {
    bits.Put(frame.id >> 18U, 11);
    bits.Put(0b11, 2);  // SRR, IDE
    bits.Put(frame.id & 0x3FFFFU, 18);
    bits.Put(0, 1);  // RRS
  } else {
    bits.Put(frame.id, 11);
    bits.Put(0b00, 2);  // RRS, IDE
  }
  bits.Put(0b101, 3);  // FDF, res, BRS
  FrameBits found;
  found.nominal = bits.Split() + kEnd;
  bits.Put(0, 1);  // ESI
  bits.Put(DataLengthCode(frame.size), 4);
  for (int i = 0; i < frame.size; ++i) bits.Put(frame.data[static_cast<std::size_t>(i)], 8);
  // Stuff count and CRC have stuff bits at fixed places: one before them, and one behind every four.
  const int checked = 4 + (frame.size > 16 ? 21 : 17);
  found.data = bits.Split() + checked + 1 + checked / 4;
  return found;
}

}  // namespace reed::bus
