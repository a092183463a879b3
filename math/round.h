// The nearest integer of a number that is small enough to be one, in one addition. RT: safe.
#pragma once

#include <bit>
#include <cstdint>

namespace reed::math {

struct Nearest {
  double value;
  std::int64_t integer;
};

/// Added to a number, it leaves no bit below one; the last bits of the sum are those of the integer.
inline constexpr double kIntegerShift = 0x1.8p52;

/// Pre: |x| < 2^51, rounding to nearest.
constexpr Nearest NearestInteger(double x) noexcept {
  const double shifted = x + kIntegerShift;
  return {shifted - kIntegerShift,
          std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(kIntegerShift)};
}

/// 2^n. Pre: -1022 <= n <= 1023.
constexpr double PowerOfTwo(std::int64_t n) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
}

}  // namespace reed::math
