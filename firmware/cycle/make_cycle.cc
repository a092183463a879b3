#include "reed/firmware/cycle/make_cycle.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "reed/bus/codec/reed_codec.h"

namespace reed {

template <int N>
std::unique_ptr<CycleBase> MakeCycleFor(const ControllerConfig& scenario, bus::Transport& transport,
                                        bool start_wanted, const strategy::ExternalLaw* law,
                                        std::unique_ptr<bus::ControllerCodec> codec);

namespace {

/// The first N of the list that is the arm's number of joints.
template <int... N>
std::unique_ptr<CycleBase> Pick(std::integer_sequence<int, N...>, const ControllerConfig& scenario,
                                bus::Transport& transport, bool start_wanted,
                                const strategy::ExternalLaw* law,
                                std::unique_ptr<bus::ControllerCodec> codec) {
  std::unique_ptr<CycleBase> cycle;
  const bool found =
      ((scenario.arm.dof() == N &&
        (cycle = MakeCycleFor<N>(scenario, transport, start_wanted, law, std::move(codec)), true)) ||
       ...);
  if (!found)
    throw std::runtime_error("arm.joint: " + std::to_string(scenario.arm.dof()) +
                             " joints; this build controls " REED_JOINTS_TEXT);
  return cycle;
}

}  // namespace

std::unique_ptr<CycleBase> MakeCycle(const ControllerConfig& scenario, bus::Transport& transport,
                                     bool start_wanted, const strategy::ExternalLaw* law,
                                     std::unique_ptr<bus::ControllerCodec> codec) {
  if (codec == nullptr) codec = std::make_unique<bus::ReedControllerCodec>();
  return Pick(std::integer_sequence<int, REED_JOINTS>{}, scenario, transport, start_wanted, law,
              std::move(codec));
}

}  // namespace reed
