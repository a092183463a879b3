#include "reed/firmware/cycle/make_cycle.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace reed {

template <int N>
std::unique_ptr<CycleBase> MakeCycleFor(const ControllerConfig& scenario, bus::Transport& transport,
                                        bool start_wanted, const strategy::ExternalLaw* law);

namespace {

/// The first N of the list that is the arm's number of joints.
template <int... N>
std::unique_ptr<CycleBase> Pick(std::integer_sequence<int, N...>, const ControllerConfig& scenario,
                                bus::Transport& transport, bool start_wanted,
                                const strategy::ExternalLaw* law) {
  std::unique_ptr<CycleBase> cycle;
  const bool found =
      ((scenario.arm.dof() == N && (cycle = MakeCycleFor<N>(scenario, transport, start_wanted, law), true)) ||
       ...);
  if (!found)
    throw std::runtime_error("arm.joint: " + std::to_string(scenario.arm.dof()) +
                             " joints; this build controls " REED_JOINTS_TEXT);
  return cycle;
}

}  // namespace

std::unique_ptr<CycleBase> MakeCycle(const ControllerConfig& scenario, bus::Transport& transport,
                                     bool start_wanted, const strategy::ExternalLaw* law) {
  return Pick(std::integer_sequence<int, REED_JOINTS>{}, scenario, transport, start_wanted, law);
}

}  // namespace reed
