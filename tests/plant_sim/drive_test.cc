#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "reed/plant/drive/drive_chain.h"
#include "reed/plant/drive/drive_state.h"
#include "reed/plant/drive/torque_output.h"

namespace reed::plant {
namespace {

using bus::DriveRequest;
using bus::DriveState;

constexpr double kAtRest = 0.0;
constexpr double kMoving = 1.0;

/// What the drives owe to the requests off, ready, enable (columns), after each previous request (blocks), at
/// rest. o off, r ready, e enabled, b braked, f fault: written out by hand, so that the table in the code has
/// a witness.
struct Row {
  DriveState from;
  const char* after_off;
  const char* after_ready;
  const char* after_enable;
};
constexpr std::array kAtRestTable{
    Row{DriveState::kOff, "oro", "ooo", "ooo"},     Row{DriveState::kReady, "orr", "ore", "orr"},
    Row{DriveState::kEnabled, "ore", "ore", "ore"}, Row{DriveState::kBraked, "obb", "obb", "obb"},
    Row{DriveState::kFault, "fff", "fff", "fff"},
};

DriveState FromLetter(char letter) {
  switch (letter) {
    case 'o':
      return DriveState::kOff;
    case 'r':
      return DriveState::kReady;
    case 'e':
      return DriveState::kEnabled;
    case 'b':
      return DriveState::kBraked;
    default:
      return DriveState::kFault;
  }
}

TEST(DriveState, EveryPairOfStateAndRequestEndsWhereTheTableSays) {
  for (const Row& row : kAtRestTable) {
    const std::array blocks{row.after_off, row.after_ready, row.after_enable};
    for (std::size_t previous = 0; previous < 3; ++previous) {
      for (std::size_t request = 0; request < 3; ++request) {
        const DriveState expected = FromLetter(blocks[previous][request]);
        EXPECT_EQ(AfterCommand(row.from, static_cast<DriveRequest>(previous),
                               static_cast<DriveRequest>(request), true),
                  expected)
            << Name(row.from) << " after request " << previous << ", now " << request;
        const DriveState moving = AfterCommand(row.from, static_cast<DriveRequest>(previous),
                                               static_cast<DriveRequest>(request), false);
        const bool would_enable = expected == DriveState::kEnabled && row.from != DriveState::kEnabled;
        EXPECT_EQ(moving, would_enable ? row.from : expected) << "while moving: " << Name(row.from);
      }
    }
  }
}

TEST(DriveState, SilenceBrakesWhatIsArmedAndNothingElse) {
  EXPECT_EQ(AfterSilence(DriveState::kOff), DriveState::kOff);
  EXPECT_EQ(AfterSilence(DriveState::kReady), DriveState::kBraked);
  EXPECT_EQ(AfterSilence(DriveState::kEnabled), DriveState::kBraked);
  EXPECT_EQ(AfterSilence(DriveState::kBraked), DriveState::kBraked);
  EXPECT_EQ(AfterSilence(DriveState::kFault), DriveState::kFault);
}

TEST(TorqueOutput, RoundsToTheNearestOf16BitCodesAndKeepsZeroAndLimitsExact) {
  const double limit_Nm = 40.0;
  const TorqueOutput output(limit_Nm, 16);
  EXPECT_DOUBLE_EQ(output.lsb_Nm(), 2.0 * limit_Nm / 65534.0);
  EXPECT_EQ(output.Apply(0.0), 0.0);
  EXPECT_DOUBLE_EQ(output.Apply(limit_Nm), limit_Nm);
  EXPECT_DOUBLE_EQ(output.Apply(-limit_Nm), -limit_Nm);
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(-limit_Nm, limit_Nm);
  double worst_Nm = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double tau = uniform(engine);
    worst_Nm = std::max(worst_Nm, std::abs(output.Apply(tau) - tau));
  }
  EXPECT_LE(worst_Nm, 0.5 * output.lsb_Nm() * (1.0 + 1e-9));
  EXPECT_GE(worst_Nm,
            0.49 * output.lsb_Nm());  // coarser would exceed the line above, finer would stay below this one
}

TEST(TorqueOutput, SaturatesBeyondTheLimit) {
  const TorqueOutput output(8.0, 16);
  EXPECT_DOUBLE_EQ(output.Apply(8.1), 8.0);
  EXPECT_DOUBLE_EQ(output.Apply(-1e9), -8.0);
  EXPECT_DOUBLE_EQ(output.Apply(std::numeric_limits<double>::infinity()), 8.0);
}

class DriveChainTest : public ::testing::Test {
 protected:
  static TrueArm TwoJoints() {
    TrueArm arm;
    arm.joints.resize(2);
    arm.torque_limit_Nm = {40.0, 8.0};
    return arm;
  }
  bool Ask(DriveRequest request, double tau_Nm = 0.0, double fastest_radps = kAtRest) {
    std::array<double, kMaxJoints> torque{};
    torque.fill(tau_Nm);
    return chain_.Command(request, torque, fastest_radps);
  }
  void Enable() {
    Ask(DriveRequest::kOff);
    Ask(DriveRequest::kReady);
    Ask(DriveRequest::kEnable);
    ASSERT_EQ(chain_.state(), DriveState::kEnabled);
  }

  DriveChain chain_{TwoJoints(), DriveConfig{}};
};

TEST_F(DriveChainTest, AStreamOfTorquesAloneNeverStartsAnArm) {
  for (int i = 0; i < 100; ++i) Ask(DriveRequest::kEnable, 5.0);
  EXPECT_EQ(chain_.state(), DriveState::kOff);
  EXPECT_TRUE(chain_.braked());
  EXPECT_EQ(chain_.torque_Nm(), Eigen::Vector2d::Zero());
}

TEST_F(DriveChainTest, AMovingArmIsNotEnabledAndNeedsANewRequestAtRest) {
  Ask(DriveRequest::kReady);
  Ask(DriveRequest::kEnable, 0.0, kMoving);
  EXPECT_EQ(chain_.state(), DriveState::kReady);
  Ask(DriveRequest::kEnable);
  EXPECT_EQ(chain_.state(), DriveState::kReady) << "at rest now, but nobody asked anew";
  Ask(DriveRequest::kReady);
  Ask(DriveRequest::kEnable);
  EXPECT_EQ(chain_.state(), DriveState::kEnabled);
}

TEST_F(DriveChainTest, TorqueFlowsOnlyWhileEnabledAndWithinEachJointsLimit) {
  Ask(DriveRequest::kReady, 5.0);
  EXPECT_EQ(chain_.torque_Nm(), Eigen::Vector2d::Zero());
  Enable();
  Ask(DriveRequest::kEnable, 20.0);
  EXPECT_NEAR(chain_.torque_Nm()[0], 20.0, 0.5 * 80.0 / 65534.0);
  EXPECT_DOUBLE_EQ(chain_.torque_Nm()[1], 8.0);
  Ask(DriveRequest::kReady, 20.0);
  EXPECT_TRUE(chain_.braked());
  EXPECT_EQ(chain_.torque_Nm(), Eigen::Vector2d::Zero());
}

TEST_F(DriveChainTest, BrakesAfterExactly20SilentPeriods) {
  Enable();
  Ask(DriveRequest::kEnable, 3.0);
  for (int i = 0; i < 19; ++i) chain_.Silence(1.0);
  EXPECT_EQ(chain_.state(), DriveState::kEnabled);
  EXPECT_NEAR(chain_.torque_Nm()[0], 3.0, 1e-3) << "until then the last torque holds";
  chain_.Silence(1.0);
  EXPECT_EQ(chain_.state(), DriveState::kBraked);
  EXPECT_EQ(chain_.torque_Nm(), Eigen::Vector2d::Zero());
}

TEST_F(DriveChainTest, EveryCommandStartsTheWaitAnew) {
  Enable();
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 19; ++j) chain_.Silence(1.0);
    Ask(DriveRequest::kEnable, 1.0);
  }
  EXPECT_EQ(chain_.state(), DriveState::kEnabled);
}

TEST_F(DriveChainTest, AfterBrakingOnlyOffReadyEnableLeadsBack) {
  Enable();
  chain_.Silence(20.0);
  for (int i = 0; i < 5; ++i) Ask(DriveRequest::kEnable, 1.0);
  Ask(DriveRequest::kReady);
  Ask(DriveRequest::kEnable, 1.0);
  EXPECT_EQ(chain_.state(), DriveState::kBraked);
  Enable();
}

TEST_F(DriveChainTest, ACommandWithATorqueThatIsNotFiniteCountsAsNone) {
  Enable();
  Ask(DriveRequest::kEnable, 3.0);
  const Eigen::VectorXd before = chain_.torque_Nm();
  for (int i = 0; i < 19; ++i) {
    EXPECT_FALSE(Ask(DriveRequest::kEnable, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(Ask(DriveRequest::kOff, std::numeric_limits<double>::infinity()));
    chain_.Silence(1.0);
  }
  EXPECT_EQ(chain_.torque_Nm(), before);
  EXPECT_EQ(chain_.state(), DriveState::kEnabled);
  chain_.Silence(1.0);
  EXPECT_EQ(chain_.state(), DriveState::kBraked) << "and does not start the wait anew";
}

TEST_F(DriveChainTest, AFaultEndsByResetOnly) {
  Enable();
  chain_.Fault();
  for (const auto request : {DriveRequest::kOff, DriveRequest::kReady, DriveRequest::kEnable})
    Ask(request, 1.0);
  EXPECT_EQ(chain_.state(), DriveState::kFault);
  EXPECT_TRUE(chain_.braked());
  chain_.Reset();
  Enable();
}

}  // namespace
}  // namespace reed::plant
