// One cycle of the Controller in the state of a case: q, dq measured, q_d, dq_d, ddq_d desired, no adaptation, no limit
// in reach, no force. RT: set-up only.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "reed/firmware/controller/for_joints.h"
#include "reed/inspect/rigid_cases.h"

namespace reed::inspect {

template <int N>
class ControllerCycle {
 public:
  static constexpr int P = kLoopParameters<N>;

  ControllerCycle(const Arm<N>& arm, const NamedValues& in, const model::Vec<kMaxParameters>& p_hat)
      : knots_(Knots(in)),
        controller_(SettingsOf(arm, in, p_hat.template head<P>()),
                    reference::JointPath<N>(knots_, kPeriod_s)) {
    Measurement<N> measured;
    measured.theta = in.Vector<N>("q");
    measured.theta_dot = in.Vector<N>("dq");
    CycleState state;
    state.all_answered = true;
    constexpr int kMostCycles = 100;
    for (int k = 0; controller_.mode() != mode::Mode::kActive; ++k) {  // the plan begins
      if (k == kMostCycles) throw CaseError("dq, q_d, dq_d, ddq_d: the controller does not start from them");
      measured.drive.fill(controller_.command().request == DriveRequest::kEnable ? DriveState::kEnabled
                                                                                 : DriveState::kReady);
      controller_.Step(measured, state);
    }
    controller_.Step(measured, state);  // a period later: the desired state of the case
  }

  const strategy::Decision<N>& decision() const noexcept { return controller_.decision(); }

 private:
  using Path = reference::JointPath<N>;
  static constexpr double kPeriod_s = 1.0;

  /// The second is the desired state of the case.
  static std::array<typename Path::Knot, 3> Knots(const NamedValues& in) {
    const typename Path::Knot knot{in.Vector<N>("q_d"), in.Vector<N>("dq_d"), in.Vector<N>("ddq_d")};
    return {knot, knot, knot};
  }

  /// The arm in the sizes of the loop.
  static model::ArmModel<N, P> LoopArm(const Arm<N>& arm) {
    if (arm.num_parameters > P)
      throw CaseError("Kd: the arm has " + std::to_string(arm.num_parameters) + " parameters; the loop of " +
                      std::to_string(N) + " joints allows 0 ... " + std::to_string(P));
    model::ArmModel<N, P> loop = model::ArmModelFrom<N, P>(arm.nominal);
    loop.tool_offset = arm.tool_offset;  // that of the case
    return loop;
  }

  static Settings<N, P> SettingsOf(const Arm<N>& arm, const NamedValues& in, const model::Vec<P>& p_hat) {
    constexpr double kNoLimit = std::numeric_limits<double>::infinity();
    const model::Vec<N> no_limit = model::Vec<N>::Constant(kNoLimit), none = model::Vec<N>::Zero();
    const model::Vec<P> no_parameters = model::Vec<P>::Zero();
    Settings<N, P> s;
    s.arm = LoopArm(arm);
    s.law = strategy::LawId::kFixedNominal;
    s.gains = {.K_d = in.Vector<N>("Kd"),
               .Lambda = in.Vector<N>("Lambda"),
               .Gamma_known = no_parameters,
               .Gamma_unknown = no_parameters,
               .p_0 = p_hat,
               .eta_0 = no_parameters,
               .sliding = {},
               .sigma0_max = 0.0,
               .sigma1_max = 0.0,
               .dead_zone = 0.0,
               .leak_p = 0.0,
               .leak_sigma = 0.0,
               .K_o = 1.0,
               .Gamma_c_known = none,
               .Gamma_c_unknown = none,
               .kappa_0 = none,
               .kappa_max = none,
               .friction_speed = 1.0,
               .subtract_observer = false};
    s.wall_present = in.Has("normal");
    if (s.wall_present) s.normal = in.Vector<3>("normal");
    s.limits = {.torque = no_limit,
                .torque_step = no_limit,
                .position_min = -no_limit,
                .position_max = no_limit,
                .speed = no_limit,
                .contact_force = kNoLimit,
                .hold_age = 1,
                .stop_age = 1};
    s.rate_hz = 1.0 / kPeriod_s;
    s.duration_s = kNoLimit;
    s.start_wanted = true;
    return s;
  }

  std::array<typename Path::Knot, 3> knots_;
  Controller<N, P> controller_;
};

}  // namespace reed::inspect
