// One translation unit per number of joints includes this: the instantiations compile side by side. Set-up
// only.
#pragma once

#include <memory>

#include "firmware/cycle.h"

namespace reed {

/// Parameter capacities the program is built for: unused columns of Y are zero and cost time, so small arms
/// get a small one.
/// Seven and the known part fill whole vector registers.
inline constexpr int kFewParameters = 7;
inline constexpr int kManyParameters = kMaxParameters;

template <int N>
std::unique_ptr<CycleBase> MakeCycleFor(const Scenario& scenario, bus::Transport& transport,
                                        bool start_wanted) {
  if (scenario.arm.num_parameters() <= kFewParameters)
    return std::make_unique<Cycle<N, kFewParameters>>(scenario, transport, start_wanted);
  return std::make_unique<Cycle<N, kManyParameters>>(scenario, transport, start_wanted);
}

}  // namespace reed
