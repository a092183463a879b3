#include "reed/embedded/core.h"

#include "reed/core/contact/force_loop.h"
#include "reed/core/law/known_force.h"
#include "reed/core/law/unknown_force.h"
#include "reed/core/model/dynamics.h"
#include "reed/core/model/regressor.h"
#include "reed/core/model/static_deflection.h"

namespace reed::embedded {
namespace {

constexpr double kPeriod = 1e-3, kObserverGain = 80.0;

protect::LimitValues<N> LimitsOf(const Arm& arm) noexcept {
  protect::LimitValues<N> v;
  v.torque = arm.torque_limit;
  v.torque_step = 1e6;
  v.position_min = arm.position_min;
  v.position_max = arm.position_max;
  v.speed = arm.speed_limit;
  v.contact_force = 60.0;
  v.hold_age = 2;
  v.stop_age = 10;
  return v;
}

template <int K>
Eigen::Matrix<double, K, 1> Read(const double (&from)[static_cast<std::size_t>(K)]) noexcept {
  return Eigen::Map<const Eigen::Matrix<double, K, 1>>(from);
}

model::Vec<P> Padded(const double (&from)[6]) noexcept {
  model::Vec<P> all = model::Vec<P>::Zero();
  all.head<6>() = Read<6>(from);
  return all;
}

template <typename Derived, std::size_t K>
void Write(const Eigen::MatrixBase<Derived>& from, double (&to)[K]) noexcept {
  std::size_t n = 0;
  for (Eigen::Index column = 0; column < from.cols(); ++column)
    for (Eigen::Index row = 0; row < from.rows(); ++row)
      if (n < K) to[n++] = from(row, column);
}

}  // namespace

Core::Core(const Arm& arm) noexcept
    : arm_(arm), observer_(kObserverGain, kPeriod), supervisor_(true), limits_(LimitsOf(arm)) {}

void Core::Step(const Case& in, Result& out) noexcept {
  const Vec q = Read<N>(in.q), dq = Read<N>(in.dq), K_d = Vec::Constant(10.0), Lambda = Vec::Constant(5.0);
  const model::Vec<P> p_hat = Padded(in.p_hat), one = model::Vec<P>::Ones();
  model::Kinematics<N> kin;
  model::ForwardKinematics<N, P>(arm_, q, dq, kin);
  Write(kin.J, out.J);

  const control::Reference<N> reference{Read<N>(in.q_d), Read<N>(in.dq_d), Read<N>(in.ddq_d)};
  const control::Auxiliary<N> aux = control::Surface<N>(reference, Lambda, q, dq);
  const Vec s = control::SlidingError<N>(aux.v, dq);
  Write(aux.v, out.v);
  Write(s, out.s);

  model::Regressor<N, P> regressor;
  model::ComputeRegressor<N, P>(arm_, kin, aux.v, aux.v_dot, regressor);
  const model::Vec<P> Yts = regressor.Y.transpose() * s;
  Write(regressor.Y, out.Y);
  Write(control::KnownForceUpdate<N, P>(one, regressor.Y, s), out.p_rate);
  Write(control::EtaRate<P>(one, Yts), out.eta_rate);
  out.sigma_0_rate = control::Sigma0Rate<N>(1.0, s);
  out.sigma_1_rate = control::Sigma1Rate<N>(1.0, s);

  const auto normal = control::PureNormalTranslation<N>(kin.J, Eigen::Vector3d::UnitZ());
  Write(normal.D, out.D);
  const Vec JtF_d = normal.J_n.transpose() * in.F_d;
  const Vec U =
      control::KnownForceTorque<N>(arm_.rotor_inertia, aux.v_dot, regressor.f(p_hat), JtF_d, K_d, s);
  Write(U, out.U_known);
  const model::Vec<P> worst =
      control::WorstCaseParameters<P>(model::Vec<P>::Zero(), Padded(in.eta_hat), control::Sign(Yts));
  const Vec sliding = control::SlidingTerm<N>(in.sigma_0, in.sigma_1, Vec::Ones(), s, control::Sign(s));
  Write(control::UnknownForceTorque<N>(arm_.rotor_inertia, aux.v_dot, regressor.f(worst), Vec::Zero(), s,
                                       sliding),
        out.U_unknown);
  control::Auxiliary<N> force = aux;
  control::ReplaceNormal<N>(normal, control::NormalSpeed({in.k_p, in.k_i, 0.0}, in.e_f, in.int_e_f), 0.0,
                            force);
  Write(force.v, out.v_force);

  const model::Bodies<N> bodies = model::BodiesFor<N, P>(arm_, p_hat);
  model::Wrench press;
  press.F = in.F_d * Eigen::Vector3d::UnitZ();
  Write(model::CompensateDeflection<N, P>(arm_, kin, bodies, press).offset, out.nodal);
  const model::MomentumModel<N> m = model::GeneralisedMomentum<N>(bodies, kin, arm_.gravity);
  observer_.Reset(Vec::Zero());
  Write(observer_.Update(m.momentum, U + m.free_rate), out.observed);
  Write(ThroughTheBus(U, in), out.torque);
}

/// Joint states in, supervisor, last gate, command out: the torques as a drive would read them.
Vec Core::ThroughTheBus(const Vec& tau, const Case& in) noexcept {
  int heard = 0;
  for (int i = 0; i < N; ++i) {
    const bus::JointStateMessage state{in.q[i], in.dq[i], tau[i], bus::DriveState::kReady, 0};
    heard += decoder_.Decode(encoder_.JointState(i, state)).reject == bus::Reject::kNone ? 1 : 0;
  }
  mode::Observation seen;
  seen.all_fresh = heard == N;
  seen.drives_ready = seen.drives_enabled = seen.settled = true;
  supervisor_.Step(seen);
  protect::Verdict verdict;
  const Vec safe = limits_.Apply(tau, 0, verdict);
  bus::CommandMessage command{0, supervisor_.Request(), {}};
  for (int i = 0; i < N; ++i) command.torque_Nm[static_cast<std::size_t>(i)] = safe[i];
  const bus::Decoded decoded = decoder_.Decode(encoder_.Command(command));
  Vec carried;
  for (int i = 0; i < N; ++i) carried[i] = decoded.command.torque_Nm[static_cast<std::size_t>(i)];
  return carried;
}

}  // namespace reed::embedded
