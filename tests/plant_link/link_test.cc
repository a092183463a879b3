// When frames arrive behind delay, jitter, loss and a wire.
#include "reed/plant/link/link.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reed/bus/codec/reed_codec.h"
#include "reed/bus/codec/wire_time.h"

namespace reed::plant {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr int kJoints = 5;

/// A controller and an arm on a link, a cycle at a time.
class Cycles {
 public:
  explicit Cycles(const LinkConfig& config, std::int64_t seed = 1, double rate_hz = 1000.0)
      : period_ns_(static_cast<std::int64_t>(1e9 / rate_hz)), link(config, Timing(rate_hz), kJoints, seed) {}

  /// Frames that the controller gets.
  int Run() {
    const std::int64_t start_ns = cycle * period_ns_;
    sampled_ns =
        link.Start(start_ns, controller_.Sync({static_cast<std::uint32_t>(cycle), bus::layout::kLayoutId}));
    std::vector<bus::Frame> answers;
    answers.reserve(kJoints + 1);
    for (int j = 0; j < kJoints; ++j)
      answers.push_back(arm_.JointState(
          j, {0.1 * j, 0.0, 1.0, bus::DriveState::kEnabled, static_cast<std::uint8_t>(cycle & 0xF)}));
    answers.push_back(arm_.Wrench({static_cast<std::uint32_t>(cycle), {1.0, 2.0, 3.0}, {}, false}));
    link.Answer(answers);
    int got = 0;
    while (link.TakeForController()) ++got;
    bus::CommandMessage command;
    command.cycle = static_cast<std::uint32_t>(cycle);
    link.Command(command, controller_.Command(command));
    ++cycle;
    return got;
  }
  /// Arrivals of all commands that are known, less the start of the cycle that each was computed in.
  std::vector<double> CommandDelays_us() {
    std::vector<double> delays;
    for (const HeardCommand* one = link.NextCommand(); one != nullptr; one = link.NextCommand()) {
      delays.push_back(1e-3 * static_cast<double>(one->at_ns - one->message.cycle * period_ns_));
      link.PopCommand();
    }
    return delays;
  }

  std::int64_t cycle = 0, sampled_ns = 0;

 private:
  static TimingConfig Timing(double rate_hz) {
    TimingConfig timing;
    timing.rate_hz = rate_hz;
    return timing;
  }
  std::int64_t period_ns_;
  bus::FrameEncoder controller_, arm_;

 public:
  Link link;
};

LinkConfig Commands(const PathConfig& path) {
  LinkConfig config;
  config.command = path;
  return config;
}
LinkConfig Measurements(const PathConfig& path) {
  LinkConfig config;
  config.measurement = path;
  return config;
}
LinkConfig OnAWire(double others = 0.0, int identifier = -1) {
  LinkConfig config;
  config.wire_time = true;
  config.foreign_load = others;
  config.foreign_id = identifier;
  return config;
}

TEST(Link, ACommandTakesOnePeriodAndItsDelay) {
  Cycles cycles(Commands({2.5e-3, 0.0, 0.0}));
  for (int k = 0; k < 10; ++k) EXPECT_EQ(cycles.Run(), kJoints + 1);
  for (const double delay_us : cycles.CommandDelays_us()) EXPECT_DOUBLE_EQ(delay_us, 3500.0);
}

TEST(Link, JitterIsWithinItsBoundAndOrderIsKept) {
  Cycles cycles(Commands({0.0, 3e-3, 0.0}));
  for (int k = 0; k < 2000; ++k) cycles.Run();
  const std::vector<double> delays = cycles.CommandDelays_us();
  ASSERT_EQ(delays.size(), 2000U);
  for (std::size_t k = 0; k < delays.size(); ++k) {
    EXPECT_TRUE(delays[k] >= 1000.0 && delays[k] <= 4000.0);
    if (k > 0) {
      EXPECT_GE(delays[k] + 1000.0, delays[k - 1] - 1e-6);
    }
  }
}

TEST(Link, LossIsTheShareThatWasAskedForAndTheSameForTheSameSeed) {
  std::vector<double> first;
  for (const int again : {0, 1}) {
    Cycles cycles(Commands({0.0, 0.0, 0.2}), 5);
    for (int k = 0; k < 3000; ++k) cycles.Run();
    const std::vector<double> delays = cycles.CommandDelays_us();
    EXPECT_NEAR(static_cast<double>(delays.size()), 0.8 * 3000, 4 * std::sqrt(3000 * 0.2 * 0.8));
    if (again == 0) first = delays;
    EXPECT_EQ(delays.size(), first.size());
  }
}

TEST(Link, MeasurementsThatAreLaterThanTheReceivePhaseComeInALaterCycle) {
  Cycles early(Measurements({0.3e-3, 0.0, 0.0})), late(Measurements({2.3e-3, 0.0, 0.0})),
      between(Measurements({0.6e-3, 0.0, 0.0}));
  EXPECT_EQ(early.Run(), kJoints + 1);  // before 40 % of the period, or what the frames take on a wire
  EXPECT_EQ(between.Run(), 0);
  EXPECT_EQ(between.Run(), kJoints + 1);
  for (int k = 0; k < 2; ++k) EXPECT_EQ(late.Run(), 0);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(late.Run(), kJoints + 1);
}

TEST(Link, LostMeasurementsNeverCome) {
  Cycles cycles(Measurements({0.0, 0.0, 0.25}));
  int got = 0;
  for (int k = 0; k < 1000; ++k) got += cycles.Run();
  EXPECT_NEAR(got, 0.75 * 6000, 4 * std::sqrt(6000 * 0.25 * 0.75));
}

TEST(Link, OnAWireNothingIsLaterThanTheSchedulesWorstCase) {
  Cycles cycles(OnAWire());
  double longest_s = 0.0;
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(cycles.Run(), kJoints + 1);
    const double heard_s = 1e-9 * static_cast<double>(cycles.sampled_ns - k * kPeriod_ns);
    EXPECT_TRUE(heard_s > 35e-6 && heard_s <= bus::FrameTime_s(8));
    longest_s = std::max(longest_s, cycles.link.times().answers_s);
  }
  EXPECT_TRUE(longest_s > 0.8 * bus::AnswerTime_s(kJoints) && longest_s <= bus::AnswerTime_s(kJoints));
  const std::vector<double> delays = cycles.CommandDelays_us();
  ASSERT_EQ(delays.size(), 1000U);
  for (const double delay_us : delays) {  // SYNC, answers, the controller's own time, the command
    EXPECT_LE(delay_us, 1e6 * (bus::CycleTime_s(kJoints) + LinkConfig{}.controller_s));
    EXPECT_GT(delay_us, 0.8e6 * bus::CycleTime_s(kJoints));
  }
}

TEST(Link, OthersOnTheWireDelayByTheBoundOfArbitration) {
  // Lower in rank than all of ours: each of our frames waits for at most one of theirs.
  Cycles cycles(OnAWire(0.25, 0x7FF));
  double longest_s = 0.0, command_s = 0.0;
  for (int k = 0; k < 5000; ++k) {
    cycles.Run();
    longest_s = std::max(longest_s, cycles.link.times().answers_s);
    command_s = std::max(command_s, cycles.link.times().command_s);
  }
  EXPECT_LE(longest_s, bus::AnswerTime_s(kJoints) + bus::FrameTime_s(64));
  EXPECT_LE(command_s, bus::CommandTime_s() + bus::FrameTime_s(64));
  EXPECT_GT(longest_s, bus::AnswerTime_s(kJoints));
  EXPECT_NEAR(cycles.link.foreign_s() / 5.0, 0.25, 0.02);
}

TEST(Link, AWireThatIsTooFullDelaysMoreAndMoreAndDropsInTheEnd) {
  Cycles cycles(OnAWire(0.6, 0x001));  // before all of ours; with our 60 % more than there is
  for (int k = 0; k < 3000; ++k) cycles.Run();
  EXPECT_GT(cycles.link.dropped(), 100);
}

}  // namespace
}  // namespace reed::plant
