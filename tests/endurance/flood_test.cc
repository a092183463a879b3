// A bus full of others' frames: the work of a cycle is bounded, as many as a real wire could carry change nothing, and more
// than that ends in a fault and not in a late or an unsafe command.
#include <gtest/gtest.h>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using test::SilRig;

constexpr int kOfAFullWire = 22;            // shortest frames in 1 ms at 1/5 Mbit/s
constexpr int kMostOfACycle = 96 + 32 + 2;  // ArmBus::kMostFrames, a batch, SYNC and command

std::vector<bus::Frame> Others(int count) {
  bus::Frame frame;
  frame.id = 0x7AB;
  frame.size = 8;
  return std::vector<bus::Frame>(static_cast<std::size_t>(count), frame);
}

int Work(const SilRig& rig) { return rig.snapshot().num_frames + rig.snapshot().frames_omitted; }

TEST(Flood, AFullWireOfOthersChangesNoCommand) {
  const Scenario scenario = LoadScenario("press_known");
  SilRig quiet(scenario), loud(scenario);
  loud.flood = Others(2 * kOfAFullWire);
  for (int k = 0; k < 600; ++k) {
    quiet.Run();
    loud.Run();
    ASSERT_EQ(quiet.mode(), loud.mode()) << "cycle " << k;
    for (std::size_t i = 0; i < 5; ++i)
      ASSERT_EQ(quiet.snapshot().control.tau[i], loud.snapshot().control.tau[i]) << "cycle " << k;
    ASSERT_LE(Work(loud), kMostOfACycle);
  }
  EXPECT_EQ(loud.mode(), mode::Mode::kActive);
  EXPECT_EQ(loud.heap_calls(), 0);
}

TEST(Flood, MoreThanACycleTakesIsAFaultAndBoundedWork) {
  SilRig rig(LoadScenario("press_known"));
  ASSERT_TRUE(rig.RunActive(0.1));
  rig.flood = Others(1000);
  bool faulted = false;
  for (int k = 0; k < 200; ++k) {
    rig.Run();
    ASSERT_LE(Work(rig), kMostOfACycle) << "cycle " << k;
    faulted = faulted || rig.mode() == mode::Mode::kFault;
    if (faulted) {
      ASSERT_TRUE(rig.TorqueIsZero());
    }
  }
  EXPECT_EQ(rig.trip(), protect::Reason::kStaleWrench) << "what it presses by is the first to be too old";
}

}  // namespace
}  // namespace reed
