// The control step as the cycle runs it, without bus and clock: strategy (kinematics, plan, nodal
// compensation, regressor, law, adaptation, observer) and the last gate. Set-up, then Run().
#pragma once

#include "reed/bench/inputs.h"
#include "reed/config/controller/controller_config.h"
#include "reed/core/safety/limits.h"
#include "reed/core/separated.h"
#include "reed/firmware/planner/path_planner.h"

namespace reed::bench {

template <int N, int P>
class ControlStep {
 public:
  explicit ControlStep(const ControllerConfig& scenario)
      : arm_(scenario.arm),
        path_(Path(scenario)),
        strategy_(scenario, arm_, path_),
        limits_(Limits(scenario)) {
    const Inputs<N> noise;
    for (int k = 0; k < kInputs; ++k) {  // near the plan, a contact force near the wanted one
      const control::Reference<N> plan = path_.At(TimeOf(k));
      Measurement<N> m;
      m.theta = plan.theta_d + 1e-3 * noise[k].v;
      m.theta_dot = plan.theta_d_dot + 1e-2 * noise[k].qd;
      m.force = (10.0 + 0.1 * noise[k].v_dot[0]) * scenario.wall.normal;
      m.wrench_age = 0;
      m.age.fill(0);
      measured_.push_back(m);
    }
    strategy_.Settle(measured_.front());
  }

  /// One period; k chooses the measurement.
  const model::Vec<N>& Run(int k) noexcept {
    const Measurement<N>& now = measured(k);
    decision_ = &strategy_.Step(now, TimeOf(k % kInputs), true);
    protect::Verdict verdict = limits_.Judge(now.theta, now.theta_dot, decision_->f, 0, 0);
    tau_ = limits_.Apply(decision_->tau_law, 0, verdict);
    return tau_;
  }

  const Measurement<N>& measured(int k) const noexcept {
    return measured_[static_cast<std::size_t>(k % kInputs)];
  }
  const strategy::Decision<N>& decision() const noexcept { return *decision_; }
  const strategy::Separated<N, P>& strategy() const noexcept { return strategy_; }

 private:
  static double TimeOf(int k) noexcept { return 0.5 + 0.02 * k; }

  reference::JointPath<N> Path(const ControllerConfig& scenario) const {
    const auto pose_of = [this](const model::Vec<N>& q) {
      model::Kinematics<N> kin;
      model::ForwardKinematics<N, P>(arm_, q, model::Vec<N>::Zero(), kin);
      return kin;
    };
    return reference::PathPlanner<N>(pose_of, scenario).Plan();
  }

  protect::LimitValues<N> Limits(const ControllerConfig& scenario) const {
    protect::LimitValues<N> v;
    v.torque = arm_.torque_limit;
    v.torque_step = scenario.limits.torque_rate_Nmps / scenario.timing.rate_hz;
    v.position_min = arm_.position_min;
    v.position_max = arm_.position_max;
    v.speed = arm_.speed_limit;
    v.contact_force = scenario.limits.contact_force_N;
    v.hold_age = scenario.limits.hold_age_cycles;
    v.stop_age = scenario.limits.stop_age_cycles;
    return v;
  }

  model::ArmModel<N, P> arm_;
  reference::JointPath<N> path_;
  strategy::Separated<N, P> strategy_;
  protect::Limits<N> limits_;
  std::vector<Measurement<N>> measured_;
  const strategy::Decision<N>* decision_ = nullptr;
  model::Vec<N> tau_ = model::Vec<N>::Zero();
};

}  // namespace reed::bench
