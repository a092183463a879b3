// An arm bus with the joints and the wrist on a fake wire.
#pragma once

#include <gtest/gtest.h>

#include "reed/bus/codec/reed_codec.h"
#include "reed/firmware/arm_bus/arm_bus.h"
#include "reed/tests/support/fake_transport.h"

namespace reed {

inline constexpr int kN = 3;
inline constexpr int kNever = Measurement<kN>::kNever;

/// The joints and the wrist, spoken frame by frame; a cycle is SYNC, answers, and what the controller makes
/// of them.
class ArmBusTest : public ::testing::Test {
 protected:
  bus::Frame Joint(int joint, std::uint32_t cycle, double position_rad) {
    return peer_.JointState(joint, {position_rad, 0.1 * joint, 1.0, bus::DriveState::kReady,
                                    static_cast<std::uint8_t>(cycle & 0xF)});
  }
  bus::Frame Wrench(std::uint32_t cycle, double force_N) {
    return peer_.Wrench({cycle, {0.0, 0.0, force_N}, {}, false});
  }
  void Put(const bus::Frame& frame) { wire_.plant.Send(std::span(&frame, 1)); }
  void PutAll(std::uint32_t cycle, int but_joint = -1) {
    for (int i = 0; i < kN; ++i)
      if (i != but_joint) Put(Joint(i, cycle, Position(i, cycle)));
  }
  static double Position(int joint, std::uint32_t cycle) { return 0.1 * joint + 0.001 * cycle; }

  void Sync(std::uint32_t cycle) {
    tap_.ClearLists();
    bus_.SendSync(cycle, tap_);
  }
  bool Receive() { return bus_.Receive(0, tap_); }
  /// A cycle in which all answer.
  void GoodCycle(std::uint32_t cycle) {
    Sync(cycle);
    PutAll(cycle);
    Put(Wrench(cycle, 5.0));
    EXPECT_TRUE(Receive());
  }
  const Measurement<kN>& seen() const { return bus_.measurement(); }
  std::uint64_t Rejected(bus::Reject why) const {
    return bus_.decode_counters().rejected[static_cast<std::size_t>(why)];
  }

  test::FakeWire wire_;
  bus::FrameEncoder peer_;
  bus::ReedControllerCodec codec_;
  ArmBus<kN> bus_{wire_.controller, codec_};
  telemetry::Snapshot tap_;
};

}  // namespace reed
