// Counts of durations in fixed memory, HDR style: 32 bins per power of two, so that every value is known to
// 3 % from 1 ns to 2 s and adding one costs a shift and an increment. Units: ns. RT: safe.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace reed::telemetry {

class Histogram {
 public:
  static constexpr int kSubBits = 5;  // 32 bins per octave
  static constexpr int kTopBits = 31;
  static constexpr std::size_t kBins = static_cast<std::size_t>(kTopBits - kSubBits + 1) << kSubBits;

  /// Negative durations (a clock that was read on two cores) count as 0.
  void Add(std::int32_t value_ns) noexcept {
    const std::int32_t value = std::max(value_ns, 0);
    ++bins_[BinOf(value)];
    ++count_;
    max_ = std::max(max_, value);
  }

  std::int64_t count() const noexcept { return count_; }
  std::int32_t max_ns() const noexcept { return max_; }
  const std::array<std::uint32_t, kBins>& bins() const noexcept { return bins_; }

  /// The largest value of the bin in which the share q of all values is reached; 0 without values.
  std::int32_t Quantile(double q) const noexcept {
    const double wanted = q * static_cast<double>(count_);
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < kBins; ++i) {
      seen += bins_[i];
      if (seen > 0 && static_cast<double>(seen) >= wanted) return std::min(LowEnd(i + 1) - 1, max_);
    }
    return max_;
  }

  /// Values below 32 have a bin of their own; above, the top six bits of a value choose its bin.
  static constexpr std::size_t BinOf(std::int32_t value) noexcept {
    const auto v = static_cast<std::uint32_t>(value);
    const int shift = std::max(static_cast<int>(std::bit_width(v)) - (kSubBits + 1), 0);
    return (static_cast<std::size_t>(shift) << kSubBits) + (v >> shift);
  }
  /// The smallest value of a bin.
  static constexpr std::int32_t LowEnd(std::size_t bin) noexcept {
    constexpr std::size_t kSub = std::size_t{1} << kSubBits;
    if (bin < 2 * kSub) return static_cast<std::int32_t>(bin);
    const std::size_t shift = (bin >> kSubBits) - 1;
    const std::uint64_t low = std::uint64_t{kSub + (bin & (kSub - 1))} << shift;
    return static_cast<std::int32_t>(std::min<std::uint64_t>(low, 0x7FFFFFFF));
  }

 private:
  std::array<std::uint32_t, kBins> bins_{};
  std::int64_t count_ = 0;
  std::int32_t max_ = 0;
};
static_assert(Histogram::BinOf(0x7FFFFFFF) == Histogram::kBins - 1);
static_assert(Histogram::LowEnd(Histogram::BinOf(1'000'000)) <= 1'000'000);
static_assert(Histogram::LowEnd(Histogram::BinOf(1'000'000) + 1) > 1'000'000);
static_assert(Histogram::LowEnd(Histogram::BinOf(1'000'000)) >= 1'000'000 * 31 / 32);

}  // namespace reed::telemetry
