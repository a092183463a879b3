// Worst-case time that frames occupy a real CAN FD wire (ISO 11898-1, 11-bit identifier, bit rate switch).
// A software bus and vcan have no bit time at all: what fits there may not fit a wire, hence this
// calculation. RT: safe.
#pragma once

#include <cstdint>

namespace reed::bus {

struct BitRates {
  double nominal_bps = 1e6;  // arbitration, acknowledge, end of frame
  double data_bps = 5e6;     // between the bit rate switch and the CRC delimiter
};

/// SOF, identifier, RRS, IDE, FDF, res, BRS: 17 bits, of which every fourth after the first may be followed
/// by a stuff bit; CRC delimiter, ACK and its delimiter, EOF, 3 bits to the next frame: 13 bits without
/// stuffing.
constexpr int NominalBits() noexcept { return 17 + (17 - 1) / 4 + 13; }

/// `size` payload bytes: ESI, DLC and data with dynamic stuffing; stuff count, CRC and their fixed stuff
/// bits.
constexpr int DataBits(int size) noexcept {
  const int stuffed = 5 + 8 * size;
  const int dynamic_stuff = (stuffed - 1) / 4;
  const bool long_crc = size > 16;
  return stuffed + dynamic_stuff + 4 + (long_crc ? 21 + 7 : 17 + 6);
}

constexpr double FrameTime_s(int size, BitRates rates = {}) noexcept {
  return NominalBits() / rates.nominal_bps + DataBits(size) / rates.data_bps;
}

/// One cycle of an arm with `joints` joints: SYNC, joints x JOINT_STATE, WRENCH, COMMAND.
double CycleTime_s(int joints, BitRates rates = {}) noexcept;

/// Of these, what a receive phase waits for: SYNC, the states, WRENCH.
double AnswerTime_s(int joints, BitRates rates = {}) noexcept;

/// Share of the period that a receive phase has where more is not needed.
inline constexpr double kReceiveShare = 0.4;

/// Of these, COMMAND.
double CommandTime_s(BitRates rates = {}) noexcept;

/// Share of the wire that the cycles take; 1 is a full wire.
double WireLoad(int joints, double rate_hz, BitRates rates = {}) noexcept;

/// True if all frames of one cycle, back to back, end before the next cycle begins. Pre: rate_hz > 0.
bool ScheduleFits(int joints, double rate_hz, BitRates rates = {}) noexcept;

/// Highest rate that ScheduleFits accepts.
double MaxRate_hz(int joints, BitRates rates = {}) noexcept;

}  // namespace reed::bus
