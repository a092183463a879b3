#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "reed/plant/sensor/encoder.h"
#include "reed/plant/sensor/random_stream.h"
#include "reed/plant/sensor/velocity_filter.h"
#include "reed/plant/sensor/wrench_sensor.h"

namespace reed::plant {
namespace {

using Eigen::Vector3d;

TEST(JointEncoder, ReadsTheNearestOfItsMarks) {
  JointEncoder encoder(20);
  EXPECT_DOUBLE_EQ(encoder.lsb_rad(), 2.0 * std::numbers::pi / 1048576.0);
  EXPECT_EQ(encoder.Read(0.0), 0.0);
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  double worst_rad = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double q = uniform(engine);
    const double reading = encoder.Read(q);
    worst_rad = std::max(worst_rad, std::abs(reading - q));
    const double marks = reading / encoder.lsb_rad();
    EXPECT_NEAR(marks, std::round(marks), 1e-6);
  }
  EXPECT_LE(worst_rad, 0.5 * encoder.lsb_rad() * (1.0 + 1e-6));
  EXPECT_GE(worst_rad, 0.49 * encoder.lsb_rad());
}

TEST(VelocityFilter, AnswersASpeedStepLikeAFirstOrderLowPass) {
  const double cutoff_hz = 120.0, speed_radps = 2.0, dt_s = 1e-3;
  VelocityFilter filter(cutoff_hz);
  filter.Reset(0.3);
  for (int k = 1; k <= 20; ++k) {
    filter.Update(0.3 + speed_radps * k * dt_s, dt_s);
    const double expected = speed_radps * (1.0 - std::exp(-2.0 * std::numbers::pi * cutoff_hz * k * dt_s));
    EXPECT_NEAR(filter.speed_radps(), expected, 1e-11);
  }
}

TEST(VelocityFilter, GivesTheSameSpeedWhateverTheSamplingInstants) {
  VelocityFilter even(120.0), uneven(120.0);
  even.Reset(0.0);
  uneven.Reset(0.0);
  for (int k = 1; k <= 10; ++k) even.Update(1.5 * k * 1e-3, 1e-3);
  double t_s = 0.0;
  for (const double dt_s : {0.2e-3, 3.1e-3, 1e-7, 2.7e-3, 3.9999e-3}) {
    t_s += dt_s;
    uneven.Update(1.5 * t_s, dt_s);
  }
  EXPECT_NEAR(t_s, 10e-3, 1e-12);
  EXPECT_NEAR(uneven.speed_radps(), even.speed_radps(), 1e-10);
}

TEST(VelocityFilter, TwoSamplesOfOneInstantChangeNothing) {
  VelocityFilter filter(120.0);
  filter.Reset(0.0);
  filter.Update(1e-3, 1e-3);
  const double before = filter.speed_radps();
  filter.Update(1e-3, 0.0);
  EXPECT_EQ(filter.speed_radps(), before);
}

struct Moments {
  double mean = 0.0, variance = 0.0, kurtosis = 0.0;
};

Moments MomentsOf(const std::vector<double>& x) {
  Moments m;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  for (const double v : x) m.variance += (v - m.mean) * (v - m.mean) / n;
  for (const double v : x) m.kurtosis += std::pow(v - m.mean, 4) / (n * m.variance * m.variance);
  return m;
}

TEST(RandomStream, IsStandardNormalInItsFirstFourMomentsAndTails) {
  RandomStream stream(7, 1);
  const int n = 200000;
  std::vector<double> x;
  int beyond_two = 0;
  for (int i = 0; i < n; ++i) {
    x.push_back(stream.Normal());
    beyond_two += std::abs(x.back()) > 2.0 ? 1 : 0;
  }
  // Five standard errors of each estimate: sqrt(1/n), sqrt(2/n), sqrt(24/n), sqrt(p(1-p)/n).
  const Moments m = MomentsOf(x);
  EXPECT_NEAR(m.mean, 0.0, 5.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(m.variance, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m.kurtosis, 3.0, 5.0 * std::sqrt(24.0 / n));
  const double p = std::erfc(std::numbers::sqrt2);
  EXPECT_NEAR(static_cast<double>(beyond_two) / n, p, 5.0 * std::sqrt(p * (1.0 - p) / n));
}

TEST(RandomStream, EqualSeedsGiveEqualNumbersAndOtherSeedsOrStreamsOthers) {
  RandomStream a(7, 1), again(7, 1), other_stream(7, 2), other_seed(8, 1),
      high_seed(7 + (std::int64_t{1} << 32), 1);
  int differing = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = a.Normal();
    EXPECT_EQ(x, again.Normal());
    differing += static_cast<int>(x != other_stream.Normal()) + static_cast<int>(x != other_seed.Normal()) +
                 static_cast<int>(x != high_seed.Normal());
  }
  EXPECT_EQ(differing, 300);
}

TEST(RandomStream, TwoStreamsOfOneSeedAreUncorrelated) {
  RandomStream a(3, 1), b(3, 2);
  const int n = 100000;
  double product = 0.0;
  for (int i = 0; i < n; ++i) product += a.Normal() * b.Normal() / n;
  EXPECT_NEAR(product, 0.0, 5.0 / std::sqrt(n));
}

TEST(WrenchSensor, AddsBiasAndNoiseOfTheConfiguredSize) {
  SensorConfig config;
  config.force_bias_N = Vector3d(0.5, -1.0, 2.0);
  WrenchSensor sensor(config, 11);
  const Vector3d force_N(3.0, 0.0, 8.0), moment_Nm(0.1, 0.2, -0.3);
  std::array<std::vector<double>, 3> f, m;
  const int n = 50000;
  for (int i = 0; i < n; ++i) {
    const WrenchReading reading = sensor.Measure(force_N, moment_Nm);
    for (int axis = 0; axis < 3; ++axis) {
      f[static_cast<std::size_t>(axis)].push_back(reading.force_N[axis]);
      m[static_cast<std::size_t>(axis)].push_back(reading.moment_Nm[axis]);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Moments force = MomentsOf(f[static_cast<std::size_t>(axis)]);
    const Moments moment = MomentsOf(m[static_cast<std::size_t>(axis)]);
    // Rounding to a quantum d adds d²/12 to the variance.
    const double force_variance =
        config.force_noise_N * config.force_noise_N + std::pow(config.force_quantum_N, 2) / 12;
    const double moment_variance =
        config.moment_noise_Nm * config.moment_noise_Nm + std::pow(config.moment_quantum_Nm, 2) / 12;
    EXPECT_NEAR(force.mean, force_N[axis] + config.force_bias_N[axis], 5.0 * std::sqrt(force_variance / n));
    EXPECT_NEAR(moment.mean, moment_Nm[axis], 5.0 * std::sqrt(moment_variance / n));
    EXPECT_NEAR(force.variance / force_variance, 1.0, 5.0 * std::sqrt(2.0 / n));
    EXPECT_NEAR(moment.variance / moment_variance, 1.0, 5.0 * std::sqrt(2.0 / n));
  }
}

TEST(WrenchSensor, WithoutNoiseRoundsToHalfAQuantum) {
  SensorConfig config;
  config.force_noise_N = 0.0;
  config.moment_noise_Nm = 0.0;
  WrenchSensor sensor(config, 1);
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> uniform(-50.0, 50.0);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d force_N(uniform(engine), uniform(engine), uniform(engine)), moment_Nm = 0.1 * force_N;
    const WrenchReading reading = sensor.Measure(force_N, moment_Nm);
    EXPECT_LE((reading.force_N - force_N).cwiseAbs().maxCoeff(), 0.5 * config.force_quantum_N * (1.0 + 1e-9));
    EXPECT_LE((reading.moment_Nm - moment_Nm).cwiseAbs().maxCoeff(),
              0.5 * config.moment_quantum_Nm * (1.0 + 1e-9));
    const Vector3d quanta = reading.force_N / config.force_quantum_N;
    EXPECT_LT((quanta - quanta.array().round().matrix()).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(WrenchSensor, ClampsToItsRangeAndSaysSo) {
  SensorConfig config;
  config.force_noise_N = 0.0;
  config.force_range_N = 100.0;
  WrenchSensor sensor(config, 1);
  EXPECT_FALSE(sensor.Measure(Vector3d(100.0, -100.0, 0.0), Vector3d::Zero()).saturated);
  const WrenchReading reading = sensor.Measure(Vector3d(100.1, -500.0, 7.0), Vector3d::Zero());
  EXPECT_TRUE(reading.saturated);
  EXPECT_EQ(reading.force_N, Vector3d(100.0, -100.0, 7.0));
}

TEST(WrenchSensor, ItsMomentsHaveABiasAndARangeToo) {
  SensorConfig config;
  config.moment_noise_Nm = 0.0;
  config.moment_range_Nm = 10.0;
  config.moment_bias_Nm = {0.5, -1.0, 0.0};
  WrenchSensor sensor(config, 1);
  WrenchReading reading = sensor.Measure(Vector3d::Zero(), Vector3d(9.5, -9.0, 7.0));
  EXPECT_FALSE(reading.saturated);
  EXPECT_EQ(reading.moment_Nm, Vector3d(10.0, -10.0, 7.0));
  reading = sensor.Measure(Vector3d::Zero(), Vector3d(0.0, -9.1, 7.0));
  EXPECT_TRUE(reading.saturated);
  EXPECT_EQ(reading.moment_Nm, Vector3d(0.5, -10.0, 7.0));
}

TEST(WrenchSensor, ResetRepeatsTheSameNoiseAndAnotherSeedDoesNot) {
  WrenchSensor sensor(SensorConfig{}, 5), other(SensorConfig{}, 6);
  std::vector<Vector3d> first;
  first.reserve(50);
  for (int i = 0; i < 50; ++i) first.push_back(sensor.Measure(Vector3d::Zero(), Vector3d::Zero()).force_N);
  sensor.Reset();
  bool differs = false;
  for (const Vector3d& force_N : first) {
    EXPECT_EQ(sensor.Measure(Vector3d::Zero(), Vector3d::Zero()).force_N, force_N);
    differs |= other.Measure(Vector3d::Zero(), Vector3d::Zero()).force_N != force_N;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace reed::plant
