// The laws (22)-(41) of a case: what the Controller decides in its state, and the equations that a case asks for apart.
// RT: set-up only.
#pragma once

#include "reed/core/contact/force_loop.h"
#include "reed/core/law/known_force.h"
#include "reed/core/law/unknown_force.h"
#include "reed/inspect/controller_cycle.h"

namespace reed::inspect {

/// A list per parameter of the arm, padded to the model's fixed size.
inline model::Vec<kMaxParameters> Padded(const NamedValues& in, const std::string& name, int num_parameters) {
  model::Vec<kMaxParameters> all = model::Vec<kMaxParameters>::Zero();
  all.head(num_parameters) = in.Vector(name, num_parameters);
  return all;
}

/// q dq q_d dq_d ddq_d with Kd, Lambda → v, vdot, s, Y and, where their inputs are there, both laws and
/// v_force.
template <int N>
void InspectControl(const Arm<N>& arm, const NamedValues& in, NamedValues& out) {
  constexpr int P = kMaxParameters;
  if (!in.HasAll("dq", "q_d", "dq_d", "ddq_d")) return;
  const int n = arm.num_parameters;
  const model::Vec<P> p_hat = in.Has("p_hat") ? Padded(in, "p_hat", n) : model::Vec<P>(model::Vec<P>::Zero());
  const ControllerCycle<N> cycle(arm, in, p_hat);
  const strategy::Decision<N>& decision = cycle.decision();
  const control::Auxiliary<N>& aux = decision.aux;
  const model::Vec<N>& s = decision.s;
  out.SetVector("v", aux.v);
  out.SetVector("vdot", aux.v_dot);
  out.SetVector("s", s);

  model::Kinematics<N> kin;
  model::ForwardKinematics<N>(arm, in.Vector<N>("q"), in.Vector<N>("dq"), kin);
  out.SetMatrix("J_world", kin.J);
  model::Regressor<N, P> regressor;
  model::ComputeRegressor(arm, kin, aux.v, aux.v_dot, regressor);
  const model::Vec<P> Yts = regressor.Y.transpose() * s;
  const model::Vec<P> ones = model::Vec<P>::Ones();
  out.SetMatrix("Y", regressor.Y, n);
  out.SetVector("YTs", Yts, n);
  out.SetVector("pdot_known_Gamma1", control::KnownForceUpdate<N, P>(ones, regressor.Y, s), n);
  out.SetVector("etadot_Gamma1", control::EtaRate<P>(ones, Yts), n);
  out.SetScalar("sigma0dot_c1", control::Sigma0Rate<N>(1.0, s));
  out.SetScalar("sigma1dot_c1", control::Sigma1Rate<N>(1.0, s));

  if (in.HasAll("eta_hat", "sigma0", "sigma1")) {
    // The case leaves out what the law adds to the paper's: K_d s and p_0 (zero here), and has sgn for sat.
    const model::Vec<P> p_worst =
        control::WorstCaseParameters<P>(model::Vec<P>::Zero(), Padded(in, "eta_hat", n), control::Sign(Yts));
    const model::Vec<N> sliding = control::SlidingTerm<N>(in.Scalar("sigma0"), in.Scalar("sigma1"),
                                                          model::Vec<N>::Ones(), s, control::Sign(s));
    out.SetVector("U_unknown",
                  control::UnknownForceTorque<N>(arm.rotor_inertia, aux.v_dot, regressor.f(p_worst),
                                                 model::Vec<N>::Zero(), s, sliding));
  }
  if (!in.Has("normal")) return;
  const control::NormalDirection<N>& normal = decision.normal;
  out.SetVector("D_oblique", normal.D);
  if (in.HasAll("F_d_normal", "p_hat")) {
    // The case presses without the force loop: the desired force of (31) comes to the torque, and v stays.
    const model::Vec<N> JtF_d = normal.J_n.transpose() * in.Scalar("F_d_normal");
    out.SetVector<N>("U_known", decision.tau_law - JtF_d);
  }
  if (in.HasAll("e_f", "int_e_f", "kp", "ki")) {
    // The filter of the force loop at rest: z is what the force error asks for.
    const control::ForceGains gains{in.Scalar("kp"), in.Scalar("ki"), 0.0};
    control::Auxiliary<N> force = aux;
    control::ReplaceNormal<N>(normal, control::NormalSpeed(gains, in.Scalar("e_f"), in.Scalar("int_e_f")),
                              0.0, force);
    out.SetVector("v_force", force.v);
  }
}

}  // namespace reed::inspect
