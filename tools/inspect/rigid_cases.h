// Kinematics (1)-(3), rigid dynamics (20) and regressor (28) of a case. RT: set-up only.
#pragma once

#include "reed/config/schema/halves.h"
#include "reed/core/model/dynamics.h"
#include "reed/core/model/regressor.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/inspect/named_values.h"

namespace reed::inspect {

/// The controller's model of the arm, and the true parameters that the numbers are asked for.
template <int N>
struct Arm : model::ArmModel<N, kMaxParameters> {
  explicit Arm(const ArmDescription& description)
      : model::ArmModel<N, kMaxParameters>(model::ArmModelFrom<N, kMaxParameters>(NominalOf(description))),
        nominal(NominalOf(description)),
        p_true(model::Vec<kMaxParameters>::Zero()) {
    for (int k = 0; k < description.num_parameters(); ++k)
      p_true[k] = description.parameters[static_cast<std::size_t>(k)].truth;
  }

  NominalArm nominal;
  model::Vec<kMaxParameters> p_true;
};

/// q → pose and Jacobian.
template <int N>
void PutPose(const Arm<N>& arm, const model::Kinematics<N>& kin, NamedValues& out) {
  const Eigen::Matrix3d R = model::TipRotation(arm, kin);
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = R;
  T.topRightCorner<3, 1>() = kin.tip;
  out.SetMatrix("T", T);
  out.SetVector("tip_xyz", kin.tip);
  out.SetVector("euler_alpha_beta_gamma", model::EulerAngles(R));
  out.SetMatrix("J_world_lin_ang", kin.J);
  model::Mat<6, N> J_body;
  J_body << R.transpose() * kin.J.template topRows<3>(), R.transpose() * kin.J.template bottomRows<3>();
  out.SetMatrix("J_body_lin_ang", J_body);
  if (N == 2) {
    model::Mat<2, N> J_xz;
    J_xz << kin.J.row(0), kin.J.row(2);
    out.SetMatrix("J_xz", J_xz);
  }
}

/// q qd [qdd] → M, G, C q̇, J̇q̇, energies, τ: rigid, without rotor inertia and friction.
template <int N>
void PutDynamics(const Arm<N>& arm, const model::Kinematics<N>& kin, const NamedValues& in,
                 NamedValues& out) {
  const model::Bodies<N> bodies = model::BodiesFor(arm, arm.p_true);
  out.SetMatrix("M", model::MassMatrix(bodies, kin));
  out.SetVector("G", model::GravityTorque(bodies, kin, arm.gravity));
  out.SetVector("C_qd", model::CoriolisTorque(bodies, kin));
  out.SetVector("Jdot_qd", model::TipAcceleration(arm, kin));
  out.SetScalar("kinetic", model::KineticEnergy(bodies, kin));
  out.SetScalar("potential", model::PotentialEnergy(bodies, kin, arm.gravity));
  if (in.Has("qdd")) {
    out.SetVector("tau", model::InverseDynamics(bodies, kin, in.Vector<N>("qdd"), arm.gravity));
  }
}

/// q qd v vd → Y (28), f (27), C; f_from_Yp and f reach the same number by two routes.
template <int N>
void PutRegressor(const Arm<N>& arm, const model::Kinematics<N>& kin, const NamedValues& in,
                  NamedValues& out) {
  const model::Vec<N> v = in.Vector<N>("v"), v_dot = in.Vector<N>("vd");
  model::Regressor<N, kMaxParameters> regressor;
  model::ComputeRegressor(arm, kin, v, v_dot, regressor);
  out.SetMatrix("Y", regressor.Y, arm.num_parameters);
  out.SetVector("f_from_Yp", regressor.f(arm.p_true));
  const model::Bodies<N> bodies = model::BodiesFor(arm, arm.p_true);
  const model::Mat<N, N> C = model::CoriolisMatrix(bodies, kin);
  out.SetMatrix("C", C);
  out.SetMatrix("C_christoffel", C);
  const model::Vec<N> f = model::MassMatrix(bodies, kin) * v_dot + C * v +
                          model::GravityTorque(bodies, kin, arm.gravity) +
                          model::ViscousFriction(arm, arm.p_true).cwiseProduct(v);
  out.SetVector("f", f);
}

/// wrench_world_at_tip acts on the origin of the last link, not on the tool point.
template <int N>
void PutExternalTorque(const model::Kinematics<N>& kin, const NamedValues& in, NamedValues& out) {
  const model::Vec6 W = in.Vector<6>("wrench_world_at_tip");
  const Eigen::Vector3d F = W.head<3>(), n = W.tail<3>() + (kin.p[N - 1] - kin.tip).cross(F);
  const model::Vec<N> torque =
      kin.J.template topRows<3>().transpose() * F + kin.J.template bottomRows<3>().transpose() * n;
  out.SetVector("tau_ext_JT_W", torque);
}

template <int N>
void InspectRigid(const Arm<N>& arm, const NamedValues& in, NamedValues& out) {
  const model::Vec<N> q = in.Vector<N>("q");
  const bool moving = in.Has("qd");
  model::Kinematics<N> kin;
  model::ForwardKinematics<N>(arm, q, moving ? in.Vector<N>("qd") : model::Vec<N>::Zero(), kin);
  PutPose(arm, kin, out);
  if (moving) PutDynamics(arm, kin, in, out);
  if (moving && in.HasAll("v", "vd")) PutRegressor(arm, kin, in, out);
  if (in.Has("wrench_world_at_tip")) PutExternalTorque(kin, in, out);
}

}  // namespace reed::inspect
