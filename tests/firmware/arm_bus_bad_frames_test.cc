// The arm as seen through frames: what is refused and counted.
#include <cmath>
#include <limits>

#include "reed/tests/firmware/arm_bus_rig.h"

namespace reed {
namespace {

TEST_F(ArmBusTest, ADamagedFrameIsCountedLeavesTheValueAndIsNotWaitedFor) {
  GoodCycle(0);
  Sync(1);
  PutAll(1, 1);
  bus::Frame damaged = Joint(1, 1, 1.5);
  damaged.data[5] ^= 0x10;
  Put(damaged);
  EXPECT_TRUE(Receive()) << "all came, waiting longer brings nothing";
  EXPECT_EQ(Rejected(bus::Reject::kCrc), 1U);
  EXPECT_EQ(seen().age[1], 1);
  EXPECT_NEAR(seen().theta[1], Position(1, 0), 1e-7);
}

TEST_F(ArmBusTest, ARepeatedFrameIsCountedAndChangesNothing) {
  Sync(0);
  const bus::Frame first = Joint(0, 0, 0.5);
  Put(first);
  Put(first);
  Put(Joint(1, 0, 0.1));
  Put(Joint(2, 0, 0.2));
  EXPECT_TRUE(Receive());
  EXPECT_EQ(Rejected(bus::Reject::kRepeated), 1U);
  EXPECT_EQ(seen().age[0], 0);
}

TEST_F(ArmBusTest, AStuckSenderThatRepeatsItselfForEverAges) {
  GoodCycle(0);
  const bus::Frame stuck = Joint(2, 1, 0.3);
  for (std::uint32_t k = 1; k <= 30; ++k) {
    Sync(k);
    PutAll(k, 2);
    Put(stuck);
    Receive();
    EXPECT_EQ(seen().age[2], static_cast<int>(k) - 1);
  }
  EXPECT_EQ(Rejected(bus::Reject::kRepeated), 29U);
}

TEST_F(ArmBusTest, ACounterThatJumpsTooFarIsRefusedOnceAndFollowedFromThere) {
  GoodCycle(0);
  for (int i = 0; i < 100; ++i) Joint(1, 0, 0.0);  // 100 frames that never arrive
  Sync(1);
  PutAll(1);
  Receive();
  EXPECT_EQ(Rejected(bus::Reject::kSequence), 1U);
  EXPECT_EQ(seen().age[1], 1);
  GoodCycle(2);
  EXPECT_EQ(seen().age[1], 0);
}

TEST_F(ArmBusTest, AMeasurementThatIsNoNumberIsRefusedAsAWhole) {
  GoodCycle(0);
  Sync(1);
  PutAll(1, 1);
  Put(Joint(1, 1, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(Receive());
  EXPECT_EQ(Rejected(bus::Reject::kRange), 1U);
  EXPECT_TRUE(seen().theta.allFinite());
  EXPECT_EQ(seen().age[1], 1);
}

TEST_F(ArmBusTest, UnknownIdentifiersAndWrongLengthsAreCountedAndPassedOver) {
  GoodCycle(0);
  Sync(1);
  bus::Frame stranger = Joint(0, 1, 0.0);
  stranger.id = 0x7AB;
  Put(stranger);
  bus::Frame cut = Joint(1, 1, 0.7);
  cut.size = 12;
  Put(cut);
  PutAll(1);
  EXPECT_TRUE(Receive());
  EXPECT_EQ(Rejected(bus::Reject::kUnknownId), 1U);
  EXPECT_EQ(Rejected(bus::Reject::kLength), 1U);
  EXPECT_NEAR(seen().theta[0], Position(0, 1), 1e-7);
}

TEST_F(ArmBusTest, AJointThatTheArmDoesNotHaveIsPassedOver) {
  Sync(0);
  Put(Joint(6, 0, 1.0));
  PutAll(0);
  EXPECT_TRUE(Receive());
  EXPECT_EQ(seen().OldestAge(), 0);
}

TEST_F(ArmBusTest, AForeignSyncOrCommandIsNoticedInItsCycle) {
  bus::FrameEncoder other;
  GoodCycle(0);
  EXPECT_FALSE(seen().foreign_controller);
  Sync(1);
  Put(other.Sync({77}));
  PutAll(1);
  Receive();
  EXPECT_TRUE(seen().foreign_controller);
  GoodCycle(2);
  EXPECT_FALSE(seen().foreign_controller);
  Sync(3);
  Put(other.Command({77, bus::DriveRequest::kEnable, {}}));
  PutAll(3);
  Receive();
  EXPECT_TRUE(seen().foreign_controller);
}

TEST_F(ArmBusTest, ADamagedSyncOrCommandIsCountedAndIsNobodysController) {
  bus::FrameEncoder other;
  GoodCycle(0);
  Sync(1);
  bus::Frame sync = other.Sync({77}), command = other.Command({77, bus::DriveRequest::kEnable, {}});
  bus::Frame cut = sync;
  sync.data[4] ^= 1U;
  command.data[4] ^= 1U;
  cut.size = 4;
  Put(sync);
  Put(command);
  Put(cut);
  PutAll(1);
  EXPECT_TRUE(Receive());
  EXPECT_FALSE(seen().foreign_controller);
  EXPECT_EQ(Rejected(bus::Reject::kCrc), 2U);
  EXPECT_EQ(Rejected(bus::Reject::kLength), 1U);
  EXPECT_EQ(seen().OldestAge(), 0) << "the arm's own frames of the same cycle count";
}

TEST_F(ArmBusTest, ARepeatedSyncIsSomebodysAllTheSame) {
  bus::FrameEncoder other;
  const bus::Frame sync = other.Sync({77});
  Sync(0);
  Put(sync);
  PutAll(0);
  Receive();
  Sync(1);
  Put(sync);
  PutAll(1);
  Receive();
  EXPECT_TRUE(seen().foreign_controller);
}

TEST_F(ArmBusTest, ABabblingBusCannotHoldTheLoop) {
  Sync(0);
  bus::Frame babble = Joint(0, 0, 0.0);
  babble.id = 0x7AB;
  for (int i = 0; i < 5000; ++i) Put(babble);
  EXPECT_FALSE(Receive());
  EXPECT_GT(wire_.controller.inbox().size(), 4000U) << "the rest waits";
}

}  // namespace
}  // namespace reed
