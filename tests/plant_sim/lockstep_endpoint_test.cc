// What a plant in lockstep answers, and when a command acts.
#include <bit>
#include <cstring>

#include "reed/tests/plant_sim/lockstep_rig.h"

namespace reed::plant {
namespace {

TEST_F(Lockstep, AnswersSyncWithEveryJointThenTheWrenchInOneBatch) {
  const Answer answer = SyncAndTake(0);
  const auto& joint_id = bus::layout::kJointState;
  EXPECT_EQ(answer.ids,
            (std::vector<std::uint32_t>{joint_id[0].id, joint_id[1].id, bus::layout::kWrench.id}));
  EXPECT_EQ(wire_.plant.batches, 1);
}

TEST_F(Lockstep, TheFirstAnswerIsTheStartAtRestWithBrakesClosed) {
  const Answer answer = SyncAndTake(0);
  EXPECT_NEAR(answer.joints[0].position_rad, 0.25, 0.5 * kLsb_rad + 1e-7);
  EXPECT_NEAR(answer.joints[1].position_rad, -1.0, 0.5 * kLsb_rad + 1e-7);
  for (const auto& joint : answer.joints) {
    EXPECT_EQ(joint.velocity_radps, 0.0);
    EXPECT_EQ(joint.torque_Nm, 0.0);
    EXPECT_EQ(joint.state, DriveState::kOff);
  }
  ASSERT_EQ(recorder_.Plants().size(), 1U);
  EXPECT_TRUE(recorder_.Plants()[0].braked);
  EXPECT_EQ(recorder_.Plants()[0].t_s, 0.0);
}

TEST_F(Lockstep, ACommandComputedInCycleKActsFromSyncKPlus1On) {
  Enable();
  const double start_rad = body_.truth().motor_angle_rad[0];
  Cycle(2, DriveRequest::kEnable, kTau_Nm);                  // computed in cycle 2 ...
  const Answer at_3 = Cycle(3, DriveRequest::kEnable, 0.0);  // ... not yet felt at 3T ...
  const Answer at_4 = Cycle(4, DriveRequest::kEnable, 0.0);  // ... felt over [3T, 4T]
  const Answer at_5 = Cycle(5, DriveRequest::kEnable, 0.0);  // and the zero of cycle 3 over [4T, 5T]
  EXPECT_EQ(at_3.joints[0].torque_Nm, 0.0);
  EXPECT_NEAR(at_4.joints[0].torque_Nm, kTau_Nm, 80.0 / 65534.0);
  EXPECT_EQ(at_5.joints[0].torque_Nm, 0.0);

  const auto truth = recorder_.Plants();
  const double tau_Nm = truth[4].torque[0];
  const double speed_radps = tau_Nm / RotorBody::kInertia_kgm2 * kPeriod_s;
  EXPECT_DOUBLE_EQ(truth[3].motor_angle[0], start_rad);
  EXPECT_NEAR(truth[4].motor_angle[0], start_rad + 0.5 * speed_radps * kPeriod_s, 1e-12);
  EXPECT_NEAR(truth[5].motor_angle[0], start_rad + 1.5 * speed_radps * kPeriod_s, 1e-12);
  EXPECT_NEAR(truth[5].motor_speed[0], speed_radps, 1e-12);
}

TEST_F(Lockstep, EachSyncIsExactlyOnePeriodAndUtimeIsSimulatedTime) {
  for (std::uint32_t k = 0; k < 50; ++k) SyncAndTake(k);
  const auto truth = recorder_.Plants();
  ASSERT_EQ(truth.size(), 50U);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(truth[k].t_s, static_cast<double>(k) * kPeriod_s, 1e-12);
    EXPECT_EQ(truth[k].cycle, static_cast<std::int64_t>(k));
    EXPECT_EQ(truth[k].utime, static_cast<std::int64_t>(k) * 1000);
  }
}

TEST_F(Lockstep, TheShapeIsRecordedAboutSixtyTimesPerSecond) {
  for (std::uint32_t k = 0; k < 52; ++k) SyncAndTake(k);
  const auto shapes = recorder_.Shapes();
  ASSERT_EQ(shapes.size(), 4U);  // every 17th cycle of 1000 per second
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    EXPECT_EQ(shapes[k].cycle, static_cast<std::int64_t>(17 * k));
    EXPECT_EQ(shapes[k].utime, static_cast<std::int64_t>(17000 * k));
    ASSERT_EQ(shapes[k].num, 2U);
    EXPECT_EQ(shapes[k].bent[0][1], 0.0F);
    EXPECT_EQ(shapes[k].rigid[0][1], 0.25F);
  }
}

TEST_F(Lockstep, UtimeIsRoundedWhenThePeriodIsNoWholeMicrosecond) {
  PlantConfig scenario = TwoJointScenario();
  scenario.timing.rate_hz = 3000.0;
  Start(scenario);
  for (std::uint32_t k = 0; k < 4; ++k) SyncAndTake(k);
  const auto truth = recorder_.Plants();
  EXPECT_EQ(truth[1].utime, 333);
  EXPECT_EQ(truth[2].utime, 667);
  EXPECT_EQ(truth[3].utime, 1000);
}

TEST_F(Lockstep, ALostSyncStillTakesItsPeriod) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 0.0);
  SyncAndTake(7);
  EXPECT_NEAR(recorder_.Plants().back().t_s, 7 * kPeriod_s, 1e-12);
  EXPECT_EQ(body_.resets, 2) << "constructor and first SYNC only";
}

TEST_F(Lockstep, BrakesCloseAfter20CyclesWithoutACommand) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 1.0);  // acts over [3T, 4T]; silence is counted from SYNC 4 on
  for (std::uint32_t k = 3; k <= 23; ++k) {
    EXPECT_EQ(SyncAndTake(k).joints[0].state, DriveState::kEnabled) << "SYNC " << k;
  }
  const Answer at_24 = SyncAndTake(24);
  EXPECT_EQ(at_24.joints[0].state, DriveState::kBraked);
  EXPECT_EQ(at_24.joints[0].torque_Nm, 0.0);
  EXPECT_EQ(recorder_.Count(PlantEvent::kBrakesReleased), 1);
  EXPECT_EQ(recorder_.Count(PlantEvent::kBrakesClosed), 1);
}

TEST_F(Lockstep, TheWrenchStopsInItsWindowCountedFromEnabling) {
  PlantConfig scenario = TwoJointScenario();
  scenario.sensors.wrench_lost_from_s = 0.010;
  scenario.sensors.wrench_lost_to_s = 0.015;
  Start(scenario);
  std::vector<std::uint32_t> lost;
  for (std::uint32_t k = 0; k < 30; ++k) {
    const Answer answer = Cycle(k, k == 0 ? DriveRequest::kReady : DriveRequest::kEnable);
    EXPECT_EQ(answer.joints.size(), 2U);
    if (answer.wrenches.empty()) lost.push_back(k);
  }
  EXPECT_EQ(lost, (std::vector<std::uint32_t>{12, 13, 14, 15, 16})) << "enabled at 2T";
  EXPECT_DOUBLE_EQ(body_.schedule_from_s, 2 * kPeriod_s) << "payload and step of force count from there too";
  EXPECT_EQ(recorder_.Count(PlantEvent::kFaultBegins), 1);
  EXPECT_EQ(recorder_.Count(PlantEvent::kFaultEnds), 1);
}

TEST_F(Lockstep, TheWrenchIsWhatTheSensorFeelsInItsAxes) {
  PlantConfig scenario = TwoJointScenario();
  scenario.sensors.force_noise_N = 0.0;
  body_.force_N = Eigen::Vector3d(1.0, -2.0, 8.25);
  Start(scenario);
  const Answer answer = SyncAndTake(0);
  ASSERT_EQ(answer.wrenches.size(), 1U);
  EXPECT_NEAR(answer.wrenches[0].force_N[0], 1.0, 1e-6);
  EXPECT_NEAR(answer.wrenches[0].force_N[1], -2.0, 1e-6);
  EXPECT_NEAR(answer.wrenches[0].force_N[2], 8.25, 1e-6);
}

TEST_F(Lockstep, EqualSeedsGiveEqualFramesAndAnotherSeedDoesNot) {
  const auto run = [](std::int64_t seed) {
    PlantConfig scenario = TwoJointScenario();
    scenario.seed = seed;
    test::FakeWire wire;
    RotorBody body;
    VectorRecorder recorder;
    LockstepEndpoint endpoint(scenario, wire.plant, body, recorder);
    FakeController controller(wire.controller);
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t k = 0; k < 100; ++k) {
      controller.Sync(k);
      endpoint.Poll(0);
      for (const bus::Frame& frame : controller.Take().frames) {
        bytes.insert(bytes.end(), frame.data.begin(), frame.data.end());
      }
      controller.Command(k, k == 0 ? DriveRequest::kReady : DriveRequest::kEnable, 0.3 * k);
      endpoint.Poll(0);
    }
    return bytes;
  };
  const auto first = run(1);
  EXPECT_EQ(first, run(1));
  EXPECT_NE(first, run(2));
}

}  // namespace
}  // namespace reed::plant
