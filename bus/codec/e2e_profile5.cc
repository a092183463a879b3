#include "reed/bus/codec/e2e_profile5.h"

#include <array>

namespace reed::bus {
namespace {

constexpr std::uint16_t kPolynomial = 0x1021;

constexpr std::array<std::uint16_t, 256> MakeTable() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned remainder = byte << 8;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder << 1) ^ ((remainder & 0x8000U) != 0 ? kPolynomial : 0U);
    }
    table[byte] = static_cast<std::uint16_t>(remainder & 0xFFFFU);
  }
  return table;
}
constexpr std::array<std::uint16_t, 256> kTable = MakeTable();

std::uint16_t FrameCrc(std::span<const std::uint8_t> frame, std::uint16_t data_id) noexcept {
  const std::array<std::uint8_t, 2> id{static_cast<std::uint8_t>(data_id & 0xFFU),
                                       static_cast<std::uint8_t>(data_id >> 8)};
  return Crc16(id, Crc16(frame.subspan(2)));
}

}  // namespace

std::uint16_t Crc16(std::span<const std::uint8_t> bytes, std::uint16_t crc) noexcept {
  for (const std::uint8_t byte : bytes) {
    crc = static_cast<std::uint16_t>((crc << 8) ^ kTable[(crc >> 8) ^ byte]);
  }
  return crc;
}

void Protect(std::span<std::uint8_t> frame, std::uint16_t data_id, std::uint8_t counter) noexcept {
  frame[2] = counter;
  const std::uint16_t crc = FrameCrc(frame, data_id);
  frame[0] = static_cast<std::uint8_t>(crc & 0xFFU);
  frame[1] = static_cast<std::uint8_t>(crc >> 8);
}

E2eCheck E2eReceiver::Check(std::span<const std::uint8_t> frame, std::uint16_t data_id) noexcept {
  if (frame.size() < kE2eHeaderSize || FrameCrc(frame, data_id) != (frame[0] | frame[1] << 8)) {
    return {E2eState::kCrcError, 0};
  }
  const auto delta = static_cast<std::uint8_t>(frame[2] - counter_);
  const bool first = !has_predecessor_;
  has_predecessor_ = true;
  counter_ = frame[2];
  if (first || delta == 1) return {E2eState::kOk, 0};
  if (delta == 0) return {E2eState::kRepeated, 0};
  if (delta > kMaxDeltaCounter) return {E2eState::kWrongSequence, 0};
  return {E2eState::kOkSomeLost, static_cast<std::uint8_t>(delta - 1)};
}

}  // namespace reed::bus
