// The nearest integer of a number that is small enough to be one, in one addition. RT: safe.
#pragma once

#include <bit>
#include <cstdint>

namespace reed::math {

struct Nearest {
  double value;
  std::int64_t integer;
};

/// Pre: |x| < 2^51, rounding to nearest. 1.5 * 2^52 leaves no bit below one.
constexpr Nearest NearestInteger(double x) noexcept {
  constexpr double kShift = 0x1.8p52;
  const double shifted = x + kShift;
  return {shifted - kShift, std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(kShift)};
}

/// 2^n. Pre: -1022 <= n <= 1023.
constexpr double PowerOfTwo(std::int64_t n) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
}

}  // namespace reed::math
