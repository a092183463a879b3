// (42)-(46): V differentiated by differences along the closed loop against what the page says V̇ is. The
// plant's acceleration is solved from (21) with the mass matrix, so nothing of the predicted V̇ enters the
// computed one.
#include "reed/core/law/lyapunov.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "reed/core/contact/force_loop.h"
#include "reed/core/law/known_force.h"
#include "reed/core/law/unknown_force.h"
#include "reed/core/model/dynamics.h"
#include "reed/core/model/regressor.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/support/arms.h"
#include "reed/tests/support/model_arm.h"

namespace reed {
namespace {

constexpr int N = 5, P = 6;
using Arm = test::ModelArm<N, P>;
using VecN = model::Vec<N>;
using VecP = model::Vec<P>;
using MatN = model::Mat<N, N>;

const Arm& A5() {
  static const Arm arm(test::ArmA5());
  return arm;
}

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  template <int R>
  model::Vec<R> Vector(double lo, double hi) {
    model::Vec<R> v;
    for (double& x : v) x = (*this)(lo, hi);
    return v;
  }

 private:
  std::mt19937 engine_;
};

model::Kinematics<N> At(const VecN& q, const VecN& qd) {
  model::Kinematics<N> kin;
  model::ForwardKinematics<N, P>(A5(), q, qd, kin);
  return kin;
}

/// M(q) + J_m for the true parameters.
MatN TrueInertia(const VecN& q) {
  const model::Bodies<N> bodies = model::BodiesFor<N, P>(A5(), A5().p_true);
  MatN M = model::MassMatrix<N>(bodies, At(q, VecN::Zero()));
  M.diagonal() += A5().rotor_inertia;
  return M;
}

VecN TrueFriction() { return model::ViscousFriction<N, P>(A5(), A5().p_true); }

/// θ̈ of (21) for torque U and force F_in at the tip: C θ̇ by the Christoffel matrix.
VecN Acceleration(const VecN& q, const VecN& qd, const VecN& U, const Eigen::Vector3d& F_in) {
  const model::Bodies<N> bodies = model::BodiesFor<N, P>(A5(), A5().p_true);
  const model::Kinematics<N> kin = At(q, qd);
  const VecN rest = model::CoriolisMatrix<N>(bodies, kin) * qd + TrueFriction().cwiseProduct(qd) +
                    model::GravityTorque<N>(bodies, kin, A5().gravity);
  const VecN wall = kin.J.topRows<3>().transpose() * F_in;
  return TrueInertia(q).lu().solve(U + wall - rest);
}

class Lyapunov : public testing::TestWithParam<unsigned> {};

TEST_P(Lyapunov, KnownForceVFallsAsEquation44SaysForAnyWallStiffness) {
  Draw draw(GetParam());
  const VecN q = draw.Vector<N>(-1.2, 1.2), qd = draw.Vector<N>(-1.0, 1.0);
  const VecN K_d = draw.Vector<N>(2.0, 40.0), Lambda = draw.Vector<N>(2.0, 20.0);
  const VecP Gamma = draw.Vector<P>(0.1, 5.0), p_hat = draw.Vector<P>(0.0, 1.0);
  const double k_e = draw(1e3, 40e3), k_p = 4e-3, k_i = 30e-3, f = draw(0.0, 20.0), f_d = draw(0.0, 20.0);
  const double f_d_dot = draw(-30.0, 30.0), integral = draw(-1.0, 1.0);
  const Eigen::Vector3d n = draw.Vector<3>(-1.0, 1.0).normalized();
  const control::ForceEnergy now{k_e, f_d - f, integral};

  // The law (22)-(34), with z = k_p e_f + k_i ∫e_f itself (no filter) and its v̇.
  const model::Kinematics<N> kin = At(q, qd);
  control::Reference<N> ref;
  ref.theta_d = q + draw.Vector<N>(-0.1, 0.1);
  ref.theta_d_dot = draw.Vector<N>(-1.0, 1.0);
  ref.theta_d_ddot = draw.Vector<N>(-1.0, 1.0);
  control::Auxiliary<N> aux = control::Surface<N>(ref, Lambda, q, qd);
  const auto normal = control::PureNormalTranslation<N>(kin.J, n);
  const double z = control::NormalSpeed({k_p, k_i, 200.0}, now.e_f, integral);
  control::ReplaceNormal<N>(normal, z, 0.0, aux);
  const VecN s = control::SlidingError<N>(aux.v, qd);
  model::Regressor<N, P> regressor;
  model::ComputeRegressor<N, P>(A5(), kin, aux.v, aux.v_dot, regressor);
  const VecN JtF_d = normal.J_n.transpose() * f_d;
  const VecN U =
      control::KnownForceTorque<N>(A5().rotor_inertia, aux.v_dot, regressor.f(p_hat), JtF_d, K_d, s);
  const VecP p_hat_dot = control::KnownForceUpdate<N, P>(Gamma, regressor.Y, s);

  const VecN s_dot = aux.v_dot - Acceleration(q, qd, U, f * n);
  const double f_dot = -k_e * normal.J_n.dot(qd);  // the wall, as the tip moves into it
  const auto V = [&](double t) {
    const VecP p_tilde = A5().p_true - (p_hat + t * p_hat_dot);
    const control::ForceEnergy then{k_e, now.e_f + t * (f_d_dot - f_dot), integral + t * now.e_f};
    return control::KnownForceV<N, P>(TrueInertia(q + t * qd), s + t * s_dot, Gamma, p_tilde, then, k_i);
  };
  constexpr double h = 1e-6;
  const double computed = (V(h) - V(-h)) / (2.0 * h);
  const double predicted = control::KnownForceVdot<N>(K_d, TrueFriction(), s, now, k_p, f_d_dot);
  EXPECT_NEAR(computed, predicted, 1e-6 * (1.0 + std::abs(predicted)));
}

TEST_P(Lyapunov, TheMeasuredForceAsFeedForwardWouldLeaveACrossTerm) {
  // The same V with −Jᵀ F_in instead of −Jᵀ F_d: s J_n e_f stays, of either sign. Why (31) feeds F_d forward.
  Draw draw(GetParam());
  const VecN q = draw.Vector<N>(-1.2, 1.2);
  const auto normal = control::PureNormalTranslation<N>(At(q, VecN::Zero()).J, Eigen::Vector3d::UnitZ());
  const VecN s = draw.Vector<N>(-1.0, 1.0);
  const double e_f = draw(1.0, 5.0);
  const double force_rate_term = -e_f * normal.J_n.dot(s);          // from e_f ė_f / k_e
  const double with_desired = s.dot(normal.J_n.transpose() * e_f);  // from sᵀ Jᵀ (F_d − F_in) (32)
  EXPECT_NEAR(force_rate_term + with_desired, 0.0, 1e-12);
  EXPECT_GT(std::abs(force_rate_term), 1e-6);
}

TEST_P(Lyapunov, UnknownForceVStaysBelowEquation46) {
  Draw draw(GetParam());
  const VecN q = draw.Vector<N>(-1.2, 1.2), qd = draw.Vector<N>(-1.0, 1.0);
  const VecN K_d = draw.Vector<N>(2.0, 40.0), Lambda = draw.Vector<N>(2.0, 20.0);
  control::UnknownForceBounds<P> b;
  b.Gamma = draw.Vector<P>(0.1, 5.0);
  b.eta = (A5().p_true - A5().p_nominal).cwiseAbs();
  b.sigma_0 = draw(1.0, 5.0), b.sigma_1 = draw(5.0, 20.0);
  b.c_0 = draw(0.5, 2.0), b.c_1 = draw(0.5, 2.0), b.rho = draw(0.5, 5.0);
  b.d_0 = draw(0.1, 5.0), b.d_1 = draw(0.0, 3.0), b.d_2 = draw(0.0, 0.5);
  const VecP eta_hat = draw.Vector<P>(0.0, 1.0);
  const double sigma_0_hat = draw(0.0, 3.0), sigma_1_hat = draw(0.0, 3.0);

  control::Reference<N> ref;
  ref.theta_d = q + draw.Vector<N>(-0.3, 0.3);
  ref.theta_d_dot = draw.Vector<N>(-1.0, 1.0);
  const control::Auxiliary<N> aux = control::Surface<N>(ref, Lambda, q, qd);
  const VecN s = control::SlidingError<N>(aux.v, qd), e_dot = ref.theta_d_dot - qd;
  const model::Kinematics<N> kin = At(q, qd);
  model::Regressor<N, P> regressor;
  model::ComputeRegressor<N, P>(A5(), kin, aux.v, aux.v_dot, regressor);
  const VecP Yts = regressor.Y.transpose() * s;
  const VecP p_hat = control::WorstCaseParameters<P>(A5().p_nominal, eta_hat, control::Sign(Yts));
  const VecN ones = VecN::Ones();
  const VecN sliding = control::SlidingTerm<N>(sigma_0_hat, sigma_1_hat, ones, s, control::Sign(s));
  const VecN U =
      control::UnknownForceTorque<N>(A5().rotor_inertia, aux.v_dot, regressor.f(p_hat), K_d, s, sliding);

  // A force at the edge of its bound (35), turned against the arm.
  const double bound = b.d_0 + b.d_1 * aux.e.norm() + b.d_2 * e_dot.norm();
  const model::Mat<3, N> J_v = kin.J.topRows<3>();
  Eigen::Vector3d F_in = -(J_v * s);
  F_in *= bound / (J_v.transpose() * F_in).norm();

  const VecN s_dot = aux.v_dot - Acceleration(q, qd, U, F_in);
  const VecP eta_dot = control::EtaRate<P>(b.Gamma, Yts);
  const double s0_dot = control::Sigma0Rate<N>(b.c_0, s), s1_dot = control::Sigma1Rate<N>(b.c_1, s);
  const auto V = [&](double t) {
    return control::UnknownForceV<N, P>(TrueInertia(q + t * qd), s + t * s_dot, aux.e + t * e_dot, b,
                                        eta_hat + t * eta_dot, sigma_0_hat + t * s0_dot,
                                        sigma_1_hat + t * s1_dot);
  };
  constexpr double h = 1e-6;
  const double computed = (V(h) - V(-h)) / (2.0 * h);
  const double bound_46 = control::UnknownForceVdotBound<N, P>(b, Lambda, s, aux.e);
  EXPECT_LE(computed, bound_46 + 1e-6 * (1.0 + std::abs(bound_46)));
  // Exactly: with η̂, σ̂ replaced by the bounds, every other term of V̇.
  const double exact = -s.dot((K_d + TrueFriction()).cwiseProduct(s)) +
                       Yts.dot(A5().p_true - A5().p_nominal) - b.eta.dot(Yts.cwiseAbs()) -
                       b.sigma_0 * s.squaredNorm() - b.sigma_1 * s.lpNorm<1>() -
                       s.dot(J_v.transpose() * F_in) + b.rho * aux.e.dot(e_dot);
  EXPECT_NEAR(computed, exact, 1e-6 * (1.0 + std::abs(exact)));
}

INSTANTIATE_TEST_SUITE_P(RandomStates, Lyapunov, testing::Range(1u, 21u));

}  // namespace
}  // namespace reed
