// What is listened for before anything moves.
#include <gtest/gtest.h>

#include "reed/bus/codec/messages.h"
#include "reed/bus/codec/reed_codec.h"
#include "reed/firmware/startup/checks.h"
#include "reed/tests/support/fake_transport.h"

namespace reed {
namespace {

class SecondController : public ::testing::Test {
 protected:
  void Put(const bus::Frame& frame) { wire_.plant.Send(std::span(&frame, 1)); }

  test::FakeWire wire_;
  bus::FrameEncoder other_;
  bus::ReedControllerCodec codec_;
};

TEST_F(SecondController, IsRefusedByItsSyncOrItsCommand) {
  Put(other_.Sync({5}));
  EXPECT_THROW(RefuseSecondController(wire_.controller, codec_), BusError);
  Put(other_.Command({5, bus::DriveRequest::kOff, {}}));
  EXPECT_THROW(RefuseSecondController(wire_.controller, codec_), BusError);
}

TEST_F(SecondController, IsNotProvedByADamagedFrame) {
  bus::Frame damaged = other_.Sync({5});
  damaged.data[0] ^= 1U;
  Put(damaged);
  EXPECT_NO_THROW(RefuseSecondController(wire_.controller, codec_));
}

}  // namespace
}  // namespace reed
