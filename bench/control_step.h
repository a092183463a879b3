// The control step as the firmware runs it, without bus and clock: one step of the Controller that presses at the end
// of its planned motion. Set-up, then Run().
#pragma once

#include <stdexcept>

#include "reed/bench/inputs.h"
#include "reed/config/controller/controller_config.h"
#include "reed/firmware/controller/for_joints.h"

REED_CONTROLLER_FOR(extern, 5)
REED_SET_UP_FOR(extern, 5)

namespace reed::bench {

template <int N, int P>
class ControlStep {
 public:
  explicit ControlStep(const ControllerConfig& scenario, const strategy::ExternalLaw* law = nullptr)
      : settings_(Endless(scenario, law)),
        path_(PathFrom(scenario, settings_.arm)),
        controller_(settings_, path_.View(), law) {
    const Inputs<N> noise;
    for (int k = 0; k < kInputs; ++k) {  // near where the plan ends, a contact force near the wanted one
      Measurement<N> m;
      m.theta = path_.knots.back().q + 1e-3 * noise[k].v;
      m.theta_dot = 1e-2 * noise[k].qd;
      m.force = (10.0 + 0.1 * noise[k].v_dot[0]) * scenario.wall.normal;
      m.wrench_age = 0;
      m.age.fill(0);
      m.drive.fill(DriveState::kEnabled);
      measured_.push_back(m);
    }
    state_.all_answered = true;
    Start(scenario);
  }

  /// One period; k chooses the measurement.
  const model::Vec<N>& Run(int k) noexcept { return controller_.Step(measured(k), state_).torque; }

  const Measurement<N>& measured(int k) const noexcept {
    return measured_[static_cast<std::size_t>(k % kInputs)];
  }
  const Controller<N, P>& controller() const noexcept { return controller_; }

 private:
  static Settings<N, P> Endless(const ControllerConfig& scenario, const strategy::ExternalLaw* law) {
    Settings<N, P> settings = SettingsFrom<N, P>(scenario, true);
    settings.duration_s = 1e9;
    settings.monitors = {};  // these measurements contradict each other: the monitors run and find nothing
    if (law != nullptr) settings.law = strategy::LawId::kExternal;
    return settings;
  }

  /// Tare, enable, and go to the end of the plan.
  void Start(const ControllerConfig& scenario) {
    constexpr int kEnabling = 200;
    Measurement<N> ready = measured_.front();
    ready.force.setZero();
    ready.drive.fill(DriveState::kReady);
    for (int k = 0; k < kEnabling; ++k) {
      if (controller_.command().request == DriveRequest::kEnable) ready.drive.fill(DriveState::kEnabled);
      controller_.Step(ready, state_);
    }
    const int planned = static_cast<int>(scenario.duration_s * scenario.timing.rate_hz);
    for (int k = 0; k < planned; ++k) Run(k);
    if (controller_.mode() != mode::Mode::kActive)
      throw std::runtime_error(std::string("the control step stopped: ") +
                               protect::Text(static_cast<int>(controller_.trip())));
  }

  Settings<N, P> settings_;
  reference::PlannedPath<N> path_;
  Controller<N, P> controller_;
  std::vector<Measurement<N>> measured_;
  CycleState state_;
};

}  // namespace reed::bench
