// A plant listens before it answers.
#include "reed/plant/process/second_arm.h"

#include <gtest/gtest.h>

#include "reed/bus/codec/reed_codec.h"
#include "reed/tests/support/fake_transport.h"

namespace reed::plant {
namespace {

class SecondArm : public ::testing::Test {
 protected:
  void Put(const bus::Frame& frame) { wire_.controller.Send(std::span(&frame, 1)); }

  test::FakeWire wire_;
  bus::FrameEncoder others_;
  bus::ReedControllerCodec codec_;
};

TEST_F(SecondArm, IsRefusedWhereAJointOrAWristAnswers) {
  Put(others_.JointState(3, {}));
  EXPECT_THROW(RefuseSecondArm(wire_.plant, codec_), rt::Failure);
  Put(others_.Wrench({}));
  try {
    RefuseSecondArm(wire_.plant, codec_);
    FAIL();
  } catch (const rt::Failure& failure) {
    EXPECT_EQ(failure.status(), rt::kDied);
    EXPECT_STREQ(failure.what(),
                 "another arm already answers on fake:memory; end it, or choose another bus with --bus");
  }
}

TEST_F(SecondArm, MayStartWhereOnlyAControllerSpeaks) {
  Put(others_.Sync({7}));
  bus::Frame damaged = others_.JointState(0, {});
  damaged.data[0] ^= 1U;
  Put(damaged);
  EXPECT_NO_THROW(RefuseSecondArm(wire_.plant, codec_));
}

}  // namespace
}  // namespace reed::plant
