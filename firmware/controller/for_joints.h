// The controller and its set-up for N joints, each compiled once (reed_controller_N) and linked by every program that has
// them: they are the slowest to compile. A source that names REED_CONTROLLER_FOR and REED_SET_UP_FOR with extern compiles
// none of it; core/controller.h alone still compiles for any size.
#pragma once

#include "reed/core/controller.h"
#include "reed/firmware/setup/settings.h"

namespace reed {

/// Parameters the loop has room for. Unused columns of Y are zero and cost time, and every capacity costs a
/// translation unit that compiles for half a minute, so each number of joints gets one: 7 and the known part
/// fill two AVX registers.
template <int N>
inline constexpr int kLoopParameters = N <= 5 ? 7 : kMaxParameters;

}  // namespace reed

// EXTERN: extern, or nothing in the one source that compiles it. Outside of every namespace.
#define REED_CONTROLLER_FOR(EXTERN, N) EXTERN template class reed::Controller<N, reed::kLoopParameters<N>>;

#define REED_SET_UP_FOR(EXTERN, N)                                                             \
  EXTERN template reed::model::ArmModel<N, reed::kLoopParameters<N>>                           \
  reed::model::ArmModelFrom<N, reed::kLoopParameters<N>>(const reed::NominalArm&);             \
  EXTERN template reed::Settings<N, reed::kLoopParameters<N>>                                  \
  reed::SettingsFrom<N, reed::kLoopParameters<N>>(const reed::ControllerConfig&, bool);        \
  EXTERN template reed::reference::PlannedPath<N> reed::PathFrom<N, reed::kLoopParameters<N>>( \
      const reed::ControllerConfig&, const reed::model::ArmModel<N, reed::kLoopParameters<N>>&);
