#include "reed/firmware/startup/checks.h"

#include <algorithm>

#include "reed/bus/codec/wire_time.h"
#include "reed/bus/listen/hears.h"
#include "reed/config/description/config_error.h"
#include "reed/config/description/number_text.h"

namespace reed {
namespace {

void RefuseBudgetBelowWire(const char* key, double budget_us, double wire_us, const char* frames) {
  if (budget_us + 0.5 >= wire_us) return;
  throw ConfigError(std::string(key) + ": " + ToShortText(budget_us) + " µs, but on a 1/5 Mbit/s wire " +
                    frames + " take " + ToShortText(wire_us) +
                    " µs; allowed: that and more, 0 for what fits, or " +
                    "scenario.allow_wire_overload = true");
}

}  // namespace

void RefuseWireOverload(const ControllerConfig& scenario) {
  const int joints = scenario.arm.dof();
  if (scenario.allow_wire_overload || bus::ScheduleFits(joints, scenario.timing.rate_hz)) return;
  throw ConfigError("timing.rate_hz: " + ToText(scenario.timing.rate_hz) + " Hz with " +
                    std::to_string(joints) + " joints loads a 1/5 Mbit/s wire to " +
                    std::to_string(static_cast<int>(100.0 * bus::WireLoad(joints, scenario.timing.rate_hz))) +
                    " %; allowed: up to " + std::to_string(static_cast<int>(bus::MaxRate_hz(joints))) +
                    " Hz, or scenario.allow_wire_overload = true");
}

TimingConfig WithBudgets(const ControllerConfig& scenario) {
  const int joints = scenario.arm.dof();
  const bool no_wire = scenario.allow_wire_overload;
  const double answers_us = no_wire ? 0.0 : 1e6 * bus::AnswerTime_s(joints);
  const double command_us = no_wire ? 0.0 : 1e6 * bus::CommandTime_s();
  TimingConfig timing = scenario.timing;
  const double period_us = 1e6 / timing.rate_hz;
  const bool free_compute = timing.compute_budget_us == 0.0, free_tx = timing.tx_budget_us == 0.0;
  if (timing.rx_budget_us == 0.0) timing.rx_budget_us = std::max(bus::kReceiveShare * period_us, answers_us);
  const double left_us = period_us - timing.rx_budget_us - timing.compute_budget_us - timing.tx_budget_us;
  const double share_us = free_compute && free_tx ? 0.5 * left_us : left_us;
  if ((free_compute || free_tx) && share_us < 1.0)
    throw ConfigError("timing.rx_budget_us: " + ToShortText(timing.rx_budget_us) +
                      " µs leave nothing of the " + ToShortText(period_us) + " µs period to " +
                      (free_compute ? "timing.compute_budget_us" : "timing.tx_budget_us"));
  if (free_compute) timing.compute_budget_us = share_us;
  if (free_tx) timing.tx_budget_us = std::max(share_us, std::min(command_us, left_us - 1.0));
  if (free_compute && free_tx) timing.compute_budget_us = left_us - timing.tx_budget_us;
  RefuseBudgetBelowWire("timing.rx_budget_us", timing.rx_budget_us, answers_us,
                        "SYNC, the states and the wrench");
  RefuseBudgetBelowWire("timing.tx_budget_us", timing.tx_budget_us, command_us, "the command");
  return timing;
}

void RefuseLockstepOnRealDrives(const bus::Transport& transport) {
  if (!bus::OnlySimulated(transport))
    throw std::runtime_error("--clock lockstep: only a simulated arm waits for its controller; on " +
                             transport.kind() + ":" + transport.interface() + " use --clock realtime");
}

void RefuseHostPauseOnRealDrives(const bus::Transport& transport) {
  if (!bus::OnlySimulated(transport))
    throw std::runtime_error("--host-pause: only a simulated arm waits for its host; run without it on " +
                             transport.kind() + ":" + transport.interface());
}

void RefuseSecondController(bus::Transport& transport, bus::ControllerCodec& codec) {
  const auto of_a_controller = [](bus::MessageKind kind) {
    return kind == bus::MessageKind::kSync || kind == bus::MessageKind::kCommand;
  };
  if (bus::Hears(transport, codec, of_a_controller))
    throw BusError("another controller already sends on " + transport.kind() + ":" + transport.interface() +
                   "; stop it, or choose another bus with --bus");
}

}  // namespace reed
