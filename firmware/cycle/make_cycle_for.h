// One translation unit per number of joints includes this: the instantiations compile side by side.
// RT: set-up only.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "reed/firmware/controller/for_joints.h"
#include "reed/firmware/cycle/cycle.h"

namespace reed {

template <int N>
std::unique_ptr<CycleBase> MakeCycleFor(const ControllerConfig& scenario, bus::Transport& transport,
                                        bool start_wanted, const strategy::ExternalLaw* law,
                                        std::unique_ptr<bus::ControllerCodec> codec) {
  constexpr int P = kLoopParameters<N>;
  if (scenario.arm.num_parameters() > P)
    throw std::runtime_error("arm.param_names: " + std::to_string(scenario.arm.num_parameters()) +
                             " parameters; the loop of " + std::to_string(N) + " joints allows 0 ... " +
                             std::to_string(P));
  Settings<N, P> settings = SettingsFrom<N, P>(scenario, start_wanted);
  if (law != nullptr) settings.law = strategy::LawId::kExternal;
  return std::make_unique<Cycle<N, P>>(settings, PathFrom(scenario, settings.arm), transport,
                                       std::move(codec), law);
}

}  // namespace reed
