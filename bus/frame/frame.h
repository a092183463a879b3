// One CAN FD frame as it travels on any transport. Plain data. RT: safe.
#pragma once

#include <array>
#include <cstdint>

namespace reed::bus {

struct Frame {
  std::uint32_t id = 0;   // 11 bits, or 29 where extended
  std::uint8_t size = 0;  // bytes used, one of the CAN FD sizes
  std::array<std::uint8_t, 64> data{};
  bool extended = false;
};

/// True for the payload sizes that CAN FD has.
constexpr bool IsCanFdSize(std::uint64_t size) noexcept {
  return size <= 8 || size == 12 || size == 16 || size == 20 || size == 24 || size == 32 || size == 48 ||
         size == 64;
}

}  // namespace reed::bus
