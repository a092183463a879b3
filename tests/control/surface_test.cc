// (22)-(25) and the sign functions.
#include "reed/core/law/surface.h"

#include <gtest/gtest.h>

#include "reed/core/law/computed_torque.h"
#include "reed/core/law/friction.h"
#include "reed/core/law/paper_printed.h"

namespace reed::control {
namespace {

TEST(Saturate, IsLinearInsideItsLayerAndSgnOutside) {
  const Vec<4> x(-1.0, -0.01, 0.02, 5.0);
  const Vec<4> y = Saturate(x, 0.04);
  EXPECT_EQ(y[0], -1.0);
  EXPECT_NEAR(y[1], -0.25, 1e-15);
  EXPECT_NEAR(y[2], 0.5, 1e-15);
  EXPECT_EQ(y[3], 1.0);
}

TEST(Saturate, WithAThinLayerIsThePapersSgn) {
  const Vec<3> x(-0.3, 0.0, 1e-6);
  EXPECT_EQ(Saturate(x, 1e-12), Sign(x));
  EXPECT_EQ(Sign(x), Vec<3>(-1.0, 0.0, 1.0));
}

TEST(Surface, SIsTheErrorsRateWithItsDecay) {
  // e(t) = e₀ exp(−Λ t) must have s = 0: the surface is where the error dies at rate Λ.
  const Vec<2> Lambda(5.0, 20.0), e_0(0.3, -0.1), theta_d(1.0, 2.0), speed(0.4, -0.2);
  Reference<2> ref;
  ref.theta_d = theta_d;
  ref.theta_d_dot = speed;
  const Vec<2> theta = theta_d - e_0, theta_dot = speed + Lambda.cwiseProduct(e_0);
  const Auxiliary<2> aux = Surface<2>(ref, Lambda, theta, theta_dot);
  EXPECT_NEAR(SlidingError<2>(aux.v, theta_dot).norm(), 0.0, 1e-14);
  EXPECT_NEAR((aux.e - e_0).norm(), 0.0, 1e-15);
  EXPECT_NEAR((aux.v_dot + Lambda.cwiseProduct(Lambda).cwiseProduct(e_0)).norm(), 0.0, 1e-12);
}

TEST(ComputedTorque, GivesTheErrorThePolesKappaAndLambda) {
  // e = a exp(−κ t) + b exp(−Λ t) obeys ë = −(κ + Λ) ė − κ Λ e: with it the wanted acceleration is θ̈_d − ë.
  const double kappa = 60.0, lambda = 15.0, a = 0.02, b = -0.05;
  const double e = a + b, e_dot = -kappa * a - lambda * b, e_ddot = kappa * kappa * a + lambda * lambda * b;
  Reference<1> ref;
  ref.theta_d_dot = Vec<1>(0.7);
  ref.theta_d_ddot = Vec<1>(3.0);
  const Vec<1> wanted =
      ComputedAcceleration<1>(ref, Vec<1>(kappa), Vec<1>(lambda), Vec<1>(e), Vec<1>(0.7 - e_dot));
  EXPECT_NEAR(wanted[0], 3.0 - e_ddot, 1e-9);
}

TEST(CoulombFriction, LearnsTheSizeOfAConstantFrictionFromSteadyMotion) {
  // One joint at constant speed with friction 0.3 N·m behind K_d: s settles where K_d s = what is not yet
  // known.
  const Vec<1> K_d(30.0), Gamma_c(300.0), v(0.1);
  Vec<1> kappa(0.0);
  for (int k = 0; k < 2000; ++k) {
    const Vec<1> s = (Vec<1>(0.3) - CoulombTorque<1>(kappa, v, 0.01)).cwiseQuotient(K_d);
    kappa += 1e-3 * CoulombUpdate<1>(Gamma_c, v, 0.01, s);
  }
  EXPECT_NEAR(kappa[0], 0.3, 1e-6);
}

TEST(PaperPrinted, EstimatesNeverGetAbovezeroSoMassesAreNegative) {
  const Vec<3> Gamma(0.05, 0.05, 0.05), Yts(2.0, -3.0, 0.0);
  const Vec<3> p_hat = PrintedParameters<3>(PrintedEta<3>(Gamma, Yts), Yts);
  EXPECT_NEAR((p_hat - Vec<3>(-0.1, -0.15, 0.0)).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace reed::control
