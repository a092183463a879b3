// One translation unit per number of joints includes this: the instantiations compile side by side.
// RT: set-up only.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "reed/firmware/cycle/cycle.h"
#include "reed/firmware/setup/settings.h"

namespace reed {

/// Parameters the loop has room for. Unused columns of Y are zero and cost time, and every capacity costs a
/// translation unit that compiles for half a minute, so each number of joints gets one: 7 and the known part
/// fill two AVX registers.
template <int N>
inline constexpr int kLoopParameters = N <= 5 ? 7 : kMaxParameters;

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
