// How long a frame really holds a CAN FD wire (ISO 11898-1:2015): its bits with the stuff bits that its own content needs.
// codec/wire_time.h has the most that any content can need. RT: safe.
#pragma once

#include "reed/bus/codec/wire_time.h"
#include "reed/bus/frame/frame.h"

namespace reed::bus {

struct FrameBits {
  int nominal = 0;  // at the bit rate of the arbitration
  int data = 0;     // at that behind the bit rate switch
};

/// Bits between this frame's last one and the next frame's first: part of `nominal`.
inline constexpr int kIntermissionBits = 3;

FrameBits BitsOf(const Frame& frame) noexcept;

inline double FrameTime_s(const Frame& frame, BitRates rates = {}) noexcept {
  const FrameBits bits = BitsOf(frame);
  return bits.nominal / rates.nominal_bps + bits.data / rates.data_bps;
}

}  // namespace reed::bus
