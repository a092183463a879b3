// The noise of the encoders, of an arm that stands.
#include <cmath>

#include "reed/plant/endpoint/journal.h"
#include "reed/plant/endpoint/robot.h"
#include "reed/tests/plant_sim/endpoint_rig.h"

namespace reed::plant {
namespace {

constexpr int kReadings = 4000;
constexpr double kNoise_rad = 1e-3;

/// [reading, joint], from where the joint stands, rad.
Eigen::MatrixXd Readings(double noise_rad, std::int64_t seed) {
  PlantConfig config = TwoJointScenario();
  config.sensors.encoder_noise_rad = noise_rad;
  config.seed = seed;
  RotorBody body;
  VectorRecorder recorder;
  Journal journal(recorder);
  Robot robot(config, body, journal);
  Eigen::MatrixXd read(kReadings, 2);
  for (int k = 0; k < kReadings; ++k) {
    const Measurement m = robot.Measure();
    for (int i = 0; i < 2; ++i)
      read(k, i) = m.joints[static_cast<std::size_t>(i)].position_rad - body.truth().motor_angle_rad[i];
  }
  return read;
}

TEST(EncoderNoise, IsNothingUnlessAskedFor) {
  EXPECT_EQ(Readings(0.0, 1), Readings(0.0, 2));
  EXPECT_LT(Readings(0.0, 1).cwiseAbs().maxCoeff(), 1e-5);  // a step of the encoder
}

TEST(EncoderNoise, HasItsDeviationAndNoMeanAndBelongsToEachJoint) {
  const Eigen::MatrixXd read = Readings(kNoise_rad, 7);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::sqrt(read.col(i).squaredNorm() / kReadings), kNoise_rad, 0.05 * kNoise_rad);
    EXPECT_LT(std::abs(read.col(i).mean()), 4.0 * kNoise_rad / std::sqrt(kReadings));
  }
  const double together = read.col(0).dot(read.col(1)) / kReadings / (kNoise_rad * kNoise_rad);
  EXPECT_LT(std::abs(together), 4.0 / std::sqrt(kReadings));
}

TEST(EncoderNoise, IsThatOfTheSeed) {
  EXPECT_EQ(Readings(kNoise_rad, 7), Readings(kNoise_rad, 7));
  EXPECT_NE(Readings(kNoise_rad, 7), Readings(kNoise_rad, 8));
}

}  // namespace
}  // namespace reed::plant
