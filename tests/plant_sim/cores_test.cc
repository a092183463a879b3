#include "reed/config/description/cores.h"

#include <gtest/gtest.h>

#include <thread>

namespace reed {
namespace {

TimingConfig On(int cpu, int plant_cpu) {
  TimingConfig timing;
  timing.cpu = cpu;
  timing.plant_cpu = plant_cpu;
  return timing;
}

TEST(Cores, WhatIsSaidIsTaken) {
  EXPECT_EQ(LoopCore(On(3, -1)), 3);
  EXPECT_EQ(PlantCore(On(3, 1)), 1);
  EXPECT_EQ(PlantCore(On(3, -1)), 3) << "the plant follows the loop";
}

TEST(Cores, ElseBothTakeTheLastOneThatTheyMayUse) {
  EXPECT_EQ(PlantCore(On(-1, -1)), LoopCore(On(-1, -1)));
  std::thread([] {
    cpu_set_t first;
    CPU_ZERO(&first);
    CPU_SET(0, &first);
    if (sched_setaffinity(0, sizeof first, &first) == 0) {
      EXPECT_EQ(LoopCore(On(-1, -1)), 0);
    }
  }).join();
}

}  // namespace
}  // namespace reed
