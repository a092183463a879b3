// Normal random numbers of one sensor: its own generator, so that one sensor's draws never shift another's.
// The engine is fixed by the C++ standard; std::normal_distribution is not, hence Box-Muller here. RT: safe.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "reed/math/exponential.h"
#include "reed/math/sine.h"

namespace reed::plant {

/// One for each source of randomness in a run.
namespace stream {
inline constexpr std::uint32_t kForce = 1, kMoment = 2;         // of the force sensor
inline constexpr std::uint32_t kCommand = 3, kMeasurement = 4;  // of the link, by direction
inline constexpr std::uint32_t kEncoder = 16;                   // of the first joint
inline constexpr std::uint32_t kFault = 1000;                   // and all above it
}  // namespace stream

class RandomStream {
 public:
  RandomStream(std::int64_t seed, std::uint32_t stream) {
    const auto bits = static_cast<std::uint64_t>(seed);
    std::seed_seq sequence{static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32U), stream};
    engine_.seed(sequence);
  }

  /// Mean 0, standard deviation 1.
  double Normal() noexcept {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * math::Log(Uniform()));
    const auto [sine, cosine] = math::SinCos(2.0 * std::numbers::pi * Uniform());
    spare_ = radius * sine;
    has_spare_ = true;
    return radius * cosine;
  }

  /// In (0, 1]: the logarithm of it is finite.
  double Uniform() noexcept { return std::ldexp(static_cast<double>((engine_() >> 11U) + 1U), -53); }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace reed::plant
