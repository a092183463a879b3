#include "reed/bus/transport/memory_transport.h"

#include <gtest/gtest.h>

#include <array>

#include "reed/tests/support/no_alloc.h"

namespace reed::bus {
namespace {

Frame Numbered(std::uint32_t id) {
  Frame frame;
  frame.id = id;
  frame.size = 8;
  frame.data[7] = static_cast<std::uint8_t>(id);
  return frame;
}

class MemoryTransportTest : public ::testing::Test {
 protected:
  void Send(MemoryTransport& from, std::uint32_t id) {
    const Frame frame = Numbered(id);
    EXPECT_EQ(from.Send(std::span(&frame, 1)), 1);
  }
  MemoryWire wire_;
  std::array<Frame, 4> out_{};
};

TEST_F(MemoryTransportTest, EachEndReceivesWhatTheOtherSentInOrderAndNothingOfItsOwn) {
  for (std::uint32_t id = 1; id <= 6; ++id) Send(wire_.controller, id);
  Send(wire_.plant, 9);
  EXPECT_EQ(wire_.plant.Receive(out_, 1, 0), 4) << "as many as there is room for";
  EXPECT_EQ(out_[0].id, 1U);
  EXPECT_EQ(out_[3].id, 4U);
  EXPECT_EQ(out_[3].data, Numbered(4).data);
  EXPECT_EQ(wire_.plant.Receive(out_, 4, 0), 2);
  EXPECT_EQ(out_[1].id, 6U);
  EXPECT_EQ(wire_.plant.Receive(out_, 1, 0), 0);
  EXPECT_EQ(wire_.controller.Receive(out_, 1, 0), 1);
  EXPECT_EQ(out_[0].id, 9U);
  EXPECT_EQ(wire_.controller.counters().frames_tx, 6U);
  EXPECT_EQ(wire_.plant.counters().frames_rx, 6U);
}

TEST_F(MemoryTransportTest, TheOtherSideWorksBeforeAFrameIsReceived) {
  wire_.controller.OnReceive([this] { Send(wire_.plant, 5); });
  EXPECT_EQ(wire_.controller.Receive(out_, 1, 0), 1);
  EXPECT_EQ(out_[0].id, 5U);
}

TEST_F(MemoryTransportTest, WhatNobodyTakesIsLostBeyondItsRoomAndCounted) {
  for (std::size_t i = 0; i < MemoryTransport::kCapacity + 3; ++i) Send(wire_.controller, 1);
  EXPECT_EQ(wire_.plant.inbox().size(), MemoryTransport::kCapacity);
  EXPECT_EQ(wire_.plant.counters().overflowed, 3U);
}

TEST_F(MemoryTransportTest, NothingLeavesAnEndThatWasCut) {
  wire_.controller.Cut();
  const Frame frame = Numbered(1);
  EXPECT_FALSE(wire_.controller.alive());
  EXPECT_TRUE(wire_.plant.alive());
  EXPECT_EQ(wire_.controller.Send(std::span(&frame, 1)), 0);
  EXPECT_EQ(wire_.plant.Receive(out_, 1, 0), 0);
}

TEST_F(MemoryTransportTest, NoSimulatedArmIsMistakenForARealOne) {
  EXPECT_EQ(wire_.controller.kind(), "memory");
  EXPECT_TRUE(OnlySimulated(wire_.controller));
}

TEST_F(MemoryTransportTest, TheHeapIsLeftAlone) {
  wire_.controller.OnReceive([this] { Send(wire_.plant, 5); });
  const test::NoAlloc guard("a wire in memory");
  for (int i = 0; i < 1000; ++i) {
    Send(wire_.controller, 1);
    EXPECT_EQ(wire_.controller.Receive(out_, 1, 0), 1);
    EXPECT_EQ(wire_.plant.Receive(out_, 1, 0), 1);
  }
}

}  // namespace
}  // namespace reed::bus
