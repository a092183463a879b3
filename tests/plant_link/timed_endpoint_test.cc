// Lockstep behind a link: with nothing on it the same bits, with a delay the closed form of a free rotor.
#include "reed/plant/link/timed_endpoint.h"

#include "reed/plant/endpoint/lockstep_endpoint.h"
#include "reed/tests/plant_sim/endpoint_rig.h"

namespace reed::plant {
namespace {

constexpr double kTau_Nm = 4.0, kPeriod_s = 1e-3;

/// A controller that enables the drives and then gives one torque.
class Rig {
 public:
  Rig(const PlantConfig& config, bool timed) {
    if (timed)
      endpoint_ = std::make_unique<TimedEndpoint>(
          config, std::make_unique<LinkTransport>(wire_.plant, config), body_, recorder);
    else
      endpoint_ = std::make_unique<LockstepEndpoint>(config, wire_.plant, body_, recorder);
  }
  void Run(std::uint32_t cycles, std::uint32_t torque_from) {
    for (; cycle < cycles; ++cycle) {
      controller_.Sync(cycle);
      endpoint_->Poll(0);
      frames += controller_.Take().frames.size();
      const bus::DriveRequest request = cycle == 0 ? bus::DriveRequest::kReady : bus::DriveRequest::kEnable;
      controller_.Command(cycle, request, cycle >= torque_from ? kTau_Nm : 0.0);
      endpoint_->Poll(0);
    }
  }
  /// SYNCs alone.
  void RunSilent(std::uint32_t cycles) {
    for (std::uint32_t k = 0; k < cycles; ++k) {
      controller_.Sync(cycle++);
      endpoint_->Poll(0);
      controller_.Take();
    }
  }
  double speed_radps() const { return body_.truth().motor_speed_radps[0]; }
  const Endpoint& endpoint() const { return *endpoint_; }

  VectorRecorder recorder;
  std::uint32_t cycle = 0;
  std::size_t frames = 0;

 private:
  test::FakeWire wire_;
  RotorBody body_;
  FakeController controller_{wire_.controller};
  std::unique_ptr<Endpoint> endpoint_;
};

TEST(TimedEndpoint, WithNothingOnTheLinkIsLockstepBitForBit) {
  Rig plain(TwoJointScenario(), false), timed(TwoJointScenario(), true);
  plain.Run(200, 20);
  timed.Run(200, 20);
  const std::vector<PlantRecord> one = plain.recorder.Plants(), other = timed.recorder.Plants();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].t_s, other[k].t_s);
    EXPECT_EQ(one[k].utime, other[k].utime);
    EXPECT_EQ(one[k].motor_angle[0], other[k].motor_angle[0]);
    EXPECT_EQ(one[k].torque[1], other[k].torque[1]);
    EXPECT_EQ(one[k].braked, other[k].braked);
  }
  EXPECT_EQ(plain.frames, timed.frames);
}

TEST(TimedEndpoint, ADelayedCommandActsLaterByItsDelay) {
  for (const double delay_s : {0.0, 0.4e-3, 2.7e-3}) {
    PlantConfig config = TwoJointScenario();
    config.link.command.delay_s = delay_s;
    Rig rig(config, true);
    rig.Run(100, 20);
    // The torque of cycle 20 acts from cycle 21 on and its delay; the last SYNC was that of cycle 99.
    const double acted_s = (99 - 21) * kPeriod_s - delay_s;
    EXPECT_NEAR(rig.speed_radps(), acted_s * kTau_Nm / RotorBody::kInertia_kgm2, 1e-3) << delay_s;
  }
}

TEST(TimedEndpoint, WithoutACommandTheBrakesCloseAfterTheirTime) {
  const PlantConfig config = TwoJointScenario();
  Rig rig(config, true);
  rig.Run(50, 10);
  rig.RunSilent(static_cast<std::uint32_t>(config.drives.command_timeout_cycles));
  EXPECT_FALSE(rig.endpoint().robot().drives().braked()) << "the last command acts for one period";
  rig.RunSilent(1);
  EXPECT_TRUE(rig.endpoint().robot().drives().braked());
}

TEST(TimedEndpoint, OnAWireItSamplesWhenTheSyncIsHeardAndSaysWhenFramesWereThrough) {
  PlantConfig config = TwoJointScenario();
  config.link.wire_time = true;
  Rig rig(config, true);
  rig.Run(300, 20);
  const std::vector<PlantRecord> plants = rig.recorder.Plants();
  const double first_s = plants.front().t_s;
  EXPECT_TRUE(first_s > 35e-6 && first_s < 56.6e-6);
  EXPECT_NEAR(plants.back().t_s, 299 * kPeriod_s + first_s, 10e-6);
  int said = 0;
  for (const Record& record : rig.recorder.records) {
    const auto* wire = std::get_if<WireRecord>(&record);
    if (wire == nullptr || wire->cycle == 0) continue;
    ++said;
    EXPECT_TRUE(wire->answers_us > 100.0 && wire->answers_us <= wire->computed_answers_us);
    EXPECT_TRUE(wire->command_us > 80.0 && wire->command_us <= wire->computed_command_us);
  }
  EXPECT_EQ(said, 299);
}

TEST(TimedEndpoint, AnotherControllerStartsOver) {
  PlantConfig config = TwoJointScenario();
  config.link.command.delay_s = 5e-3;
  Rig rig(config, true);
  rig.Run(50, 10);
  rig.cycle = 0;
  rig.Run(4, 10);  // what the first one sent does not reach the arm of the second
  EXPECT_EQ(rig.speed_radps(), 0.0);
  EXPECT_EQ(rig.recorder.Count(PlantEvent::kControllerRestarted), 1);
}

}  // namespace
}  // namespace reed::plant
