#include "reed/bus/wire/wire.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reed/math/exponential.h"

namespace reed::bus {
namespace {

constexpr std::array<std::uint8_t, 16> kSizes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

std::int64_t Nanoseconds(double s) noexcept { return std::llround(1e9 * s); }

/// As arbitration decides: an identifier of 11 bits before a longer one that begins with it.
std::uint64_t Priority(const Frame& frame) noexcept {
  return frame.extended ? (std::uint64_t{frame.id} << 1U) | 1U : std::uint64_t{frame.id} << 19U;
}

}  // namespace

Wire::Wire(const ForeignTraffic& others, BitRates rates)
    : rates_(rates), others_(others), random_(others.seed) {
  if (others_.load <= 0.0) {
    foreign_.ready_ns = kNever_ns;
    return;
  }
  double mean_s = 0.0;  // by trying: how many stuff bits random content needs
  constexpr int kTries = 4096;
  for (int i = 0; i < kTries; ++i) {
    DrawForeign();
    mean_s += FrameTime_s(foreign_.frame, rates_) / kTries;
  }
  mean_gap_ns_ = 1e9 * mean_s / others_.load;
  DrawForeign();
}

double Wire::Uniform() noexcept { return std::ldexp(static_cast<double>((random_() >> 11U) + 1U), -53); }

void Wire::DrawForeign() noexcept {
  Frame& frame = foreign_.frame;
  frame.id = others_.identifier >= 0 ? static_cast<std::uint32_t>(others_.identifier)
                                     : static_cast<std::uint32_t>(random_() & 0x7FFU);
  frame.size = kSizes[random_() % kSizes.size()];
  for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random_());
  foreign_.ready_ns += std::llround(-mean_gap_ns_ * math::Log(Uniform()));
}

std::int64_t Wire::Length_ns(const Frame& frame) const noexcept {
  return Nanoseconds(FrameTime_s(frame, rates_));
}

bool Wire::Offer(const Frame& frame, std::int64_t ready_ns) noexcept {
  if (count_ == waiting_.size()) return false;
  waiting_[count_++] = {frame, ready_ns};
  return true;
}

std::optional<Sent> Wire::Next(std::int64_t horizon_ns) noexcept {
  while (true) {
    std::int64_t first_ns = foreign_.ready_ns;
    for (std::size_t i = 0; i < count_; ++i) first_ns = std::min(first_ns, waiting_[i].ready_ns);
    const std::int64_t start_ns = std::max(free_ns_, first_ns);
    if (start_ns >= horizon_ns) return std::nullopt;

    const Waiting* wins = foreign_.ready_ns <= start_ns ? &foreign_ : nullptr;
    for (std::size_t i = 0; i < count_; ++i) {
      const Waiting& one = waiting_[i];
      const bool may = one.ready_ns <= start_ns;
      if (may && (wins == nullptr || Priority(one.frame) < Priority(wins->frame))) wins = &one;
    }
    const std::int64_t length_ns = Length_ns(wins->frame);
    free_ns_ = start_ns + length_ns;
    if (wins == &foreign_) {
      foreign_ns_ += length_ns;
      DrawForeign();
      continue;
    }
    const std::int64_t rest_ns = Nanoseconds(kIntermissionBits / rates_.nominal_bps);
    const Sent sent{wins->frame, wins->ready_ns, free_ns_ - rest_ns};
    const auto at = static_cast<std::size_t>(wins - waiting_.data());
    std::copy(waiting_.begin() + static_cast<std::ptrdiff_t>(at) + 1,
              waiting_.begin() + static_cast<std::ptrdiff_t>(count_),
              waiting_.begin() + static_cast<std::ptrdiff_t>(at));
    --count_;
    return sent;
  }
}

}  // namespace reed::bus
