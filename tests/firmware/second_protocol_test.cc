// The drive protocol is a seam: another one on both sides, and the same arm does the same, to the bit.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "reed/tests/firmware/paired_protocol.h"
#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using mode::Mode;
using test::SilRig;

constexpr int kJoints = 5;

TEST(SecondProtocol, MovesAndPressesTheArmAsReedsOwnDoes) {
  const Scenario scenario = LoadScenario("press_known");
  SilRig own(scenario);
  SilRig paired(scenario, true, std::make_unique<test::PairedController>(kJoints),
                std::make_unique<test::PairedArm>(kJoints));
  double pressed_N = 0.0;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_EQ(paired.Run(), own.Run()) << "cycle " << k;
    const telemetry::Snapshot &a = paired.snapshot(), &b = own.snapshot();
    ASSERT_EQ(a.measured.position, b.measured.position) << "cycle " << k;
    ASSERT_EQ(a.measured.force, b.measured.force) << "cycle " << k;
    ASSERT_EQ(a.control.tau, b.control.tau) << "cycle " << k;
    ASSERT_EQ(paired.truth().tip, own.truth().tip) << "cycle " << k;
    pressed_N = std::max(pressed_N, paired.truth().normal_force);
  }
  EXPECT_EQ(paired.mode(), Mode::kActive);
  EXPECT_GT(pressed_N, 7.0) << "the force mode was part of it";
  EXPECT_EQ(paired.heap_calls(), 0);
}

TEST(SecondProtocol, ACycleIsOneFramePerJointEachWayAndTheWrist) {
  SilRig rig(LoadScenario("press_known"), true, std::make_unique<test::PairedController>(kJoints),
             std::make_unique<test::PairedArm>(kJoints));
  ASSERT_TRUE(rig.RunActive(0.01));
  const telemetry::Snapshot& now = rig.snapshot();
  ASSERT_EQ(now.num_frames, 2 * kJoints + 1);
  std::vector<std::uint32_t> ids;
  now.ForEachFrame([&ids](const telemetry::RecordedFrame& one) {
    EXPECT_TRUE(one.frame.extended);
    ids.push_back(one.frame.id);
  });
  EXPECT_EQ(ids.front(), test::kQuery);
  EXPECT_EQ(ids[kJoints], test::kReply);
}

TEST(SecondProtocol, AnArmOfTheOtherProtocolIsNotHeard) {
  SilRig rig(LoadScenario("press_known"), true, std::make_unique<test::PairedController>(kJoints));
  EXPECT_FALSE(rig.RunActive(0.01));
  EXPECT_EQ(rig.snapshot().measured.age[0], rig.snapshot().measured.age[kJoints - 1]);
  EXPECT_GT(rig.snapshot().measured.age[0], 900);
}

}  // namespace
}  // namespace reed
