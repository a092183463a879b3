#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reed/plant/drive/torque_excitation.h"

namespace reed::plant {
namespace {

TEST(TorqueExcitation, IsNothingUnlessAskedFor) { EXPECT_FALSE(TorqueExcitation(DriveConfig{}).active()); }

TEST(TorqueExcitation, IsTheSumOfItsLines) {
  DriveConfig config;
  config.excitation_joint = 3;
  config.excitation_Nm = 0.5;
  config.excitation_hz = {1.0, 3.0};
  const TorqueExcitation excitation(config);
  ASSERT_TRUE(excitation.active());
  EXPECT_EQ(excitation.joint(), 2);
  // Phases 0 and -π: k (k - 1) π / K with K = 2.
  for (const double t : {0.0, 0.1, 0.77}) {
    const double w = 2.0 * std::numbers::pi * t;
    EXPECT_NEAR(excitation.At(t), 0.5 * (std::cos(w) - std::cos(3.0 * w)), 1e-12);
  }
}

}  // namespace
}  // namespace reed::plant
