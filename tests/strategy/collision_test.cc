#include "reed/core/estimate/collision.h"

#include <gtest/gtest.h>

namespace reed::strategy {
namespace {

using Vec = Eigen::Matrix<double, 2, 1>;

TEST(CollisionDetector, ReportsABlowOnceWithItsJointAndAnotherOneLater) {
  CollisionDetector<2> detector(Vec(6.0, 3.0), 1e-3);
  detector.Reset(Vec::Zero());
  int reports = 0, joint = -1;
  const auto run = [&](const Vec& r, int cycles) {
    for (int k = 0; k < cycles; ++k) {
      const Collision seen = detector.Step(r);
      if (seen.joint >= 0) ++reports, joint = seen.joint;
    }
  };
  run(Vec(1.0, 4.0), 50);
  EXPECT_EQ(reports, 1);
  EXPECT_EQ(joint, 1);
  run(Vec::Zero(), 1000);
  EXPECT_EQ(reports, 1) << "its end is no second blow";
  run(Vec(-9.0, 0.0), 50);
  EXPECT_EQ(reports, 2);
  EXPECT_EQ(joint, 0);
}

TEST(CollisionDetector, APayloadThatIsPutOnSlowlyIsNoBlow) {
  CollisionDetector<2> detector(Vec(6.0, 3.0), 1e-3);
  detector.Reset(Vec::Zero());
  for (int k = 0; k < 3000; ++k) EXPECT_LT(detector.Step(Vec(0.005 * k, 0.002 * k)).joint, 0);
}

}  // namespace
}  // namespace reed::strategy
