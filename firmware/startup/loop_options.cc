#include "reed/firmware/startup/loop_options.h"

namespace reed {
namespace {

std::int32_t Nanoseconds(double us) { return static_cast<std::int32_t>(us * 1e3); }

}  // namespace

LoopOptions LoopOptionsFrom(const TimingConfig& timing) {
  static_assert(static_cast<int>(TimingConfig::Overrun::kStop) == static_cast<int>(rt::OverrunPolicy::kStop));
  static_assert(static_cast<int>(TimingConfig::PhaseAction::kFault) ==
                static_cast<int>(rt::PhaseAction::kFault));
  LoopOptions options;
  options.rate_hz = timing.rate_hz;
  options.phases.budget_ns = {Nanoseconds(timing.rx_budget_us), Nanoseconds(timing.compute_budget_us),
                              Nanoseconds(timing.tx_budget_us)};
  options.phases.action = static_cast<rt::PhaseAction>(timing.phase_action);
  options.phases.max_in_row = timing.max_broken_in_row;
  options.overrun = static_cast<rt::OverrunPolicy>(timing.overrun);
  options.max_missed_in_row = timing.max_missed_in_row;
  options.first_cycle = timing.first_cycle;
  return options;
}

}  // namespace reed
