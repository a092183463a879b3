// (7)-(11), (17): one member as the plant discretises it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "reed/plant/dynamics/modes.h"

namespace reed::plant {
namespace {

constexpr double kLength = 0.3, kEI = 537.3, kRhoA = 0.299;

/// Roots of 1 + cos β cosh β + r β (cos β sinh β - sin β cosh β) = 0: clamped beam, point mass r ρA L at its
/// tip.
std::vector<double> TranscendentalModesHz(double mass_ratio, int count) {
  const auto f = [mass_ratio](double b) {
    return 1.0 / std::cosh(b) + std::cos(b) + mass_ratio * b * (std::cos(b) * std::tanh(b) - std::sin(b));
  };
  std::vector<double> hz;
  for (double lo = 0.1; static_cast<int>(hz.size()) < count; lo += 0.01) {
    double a = lo, b = lo + 0.01;
    if (f(a) * f(b) > 0.0) continue;
    for (int i = 0; i < 60; ++i) {
      const double m = 0.5 * (a + b);
      (f(a) * f(m) <= 0.0 ? b : a) = m;
    }
    hz.push_back(a * a * std::sqrt(kEI / kRhoA) / (kLength * kLength) / (2.0 * std::numbers::pi));
  }
  return hz;
}

class BeamModesTest : public testing::TestWithParam<double> {
 protected:
  std::vector<double> RelativeErrors(int elements) const {
    const std::vector<double> exact = TranscendentalModesHz(GetParam(), 3);
    const std::vector<double> ours = BeamModes(kLength, kEI, kRhoA, GetParam() * kRhoA * kLength, elements);
    std::vector<double> errors;
    for (std::size_t i = 0; i < 3; ++i) errors.push_back(ours[i] / exact[i] - 1.0);
    return errors;
  }
};

TEST_P(BeamModesTest, DefaultDiscretisationMeetsTheFirstThreeModes) {
  const std::vector<double> error = RelativeErrors(PlantModelConfig{}.elements_per_link);
  EXPECT_LT(std::abs(error[0]), 0.005);
  EXPECT_LT(std::abs(error[1]), 0.02);
  EXPECT_LT(std::abs(error[2]), 0.05);
}

TEST_P(BeamModesTest, MoreElementsConvergeFromAbove) {
  // Rayleigh: the discretised beam is stiffer than the beam, and halving its elements gains at least 2⁶ in
  // these modes.
  const std::vector<double> one = RelativeErrors(1), two = RelativeErrors(2), four = RelativeErrors(4);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(one[i], -1e-10);
    EXPECT_GT(two[i], -1e-10);
    EXPECT_LT(two[i], std::max(one[i] / 15.0, 1e-10));
    EXPECT_LT(four[i], std::max(two[i] / 60.0, 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(TipMassRatios, BeamModesTest, testing::Values(0.0, 0.5, 1.0, 5.0));

TEST(BeamModes, ImpossibleBeamsAreRefused) {
  EXPECT_THROW(BeamModes(0.0, 1.0, 1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(BeamModes(1.0, -1.0, 1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(BeamModes(1.0, 1.0, std::nan(""), 0.0), std::invalid_argument);
  EXPECT_THROW(BeamModes(1.0, 1.0, 1.0, 0.0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace reed::plant
