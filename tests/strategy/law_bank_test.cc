// Every law by name: what it commands at one state, and what it learns from it.
#include "reed/core/law/law_bank.h"

#include <gtest/gtest.h>

#include "reed/config/schema/halves.h"
#include "reed/firmware/setup/settings.h"
#include "reed/tests/support/arms.h"

namespace reed::strategy {
namespace {

constexpr int N = 5, P = 6;
using VecN = model::Vec<N>;
using VecP = model::Vec<P>;

class LawBankTest : public testing::Test {
 protected:
  LawBankTest() : arm(model::ArmModelFrom<N, P>(NominalOf(test::ArmA5()))) {
    scenario.arm = NominalOf(test::ArmA5());
    scenario.control.K_d = {45.0, 41.0, 24.0, 7.5, 4.2};
    scenario.control.Lambda = {20.0, 20.0, 20.0, 20.0, 20.0};
    VecN q, qd;
    q << 0.1, 0.6, -1.0, -0.7, 0.2;
    qd << 0.2, -0.3, 0.1, 0.4, -0.1;
    model::ForwardKinematics<N, P>(arm, q, qd, kin);
    aux.v << 0.3, -0.1, 0.2, 0.1, -0.2;
    aux.v_dot << 1.0, -2.0, 0.5, 0.3, -0.4;
    s = aux.v - qd;
    model::ComputeRegressor<N, P>(arm, kin, aux.v, aux.v_dot, regressor);
    JtF_d = 8.0 * kin.J.row(2).transpose();
    r << 1.0, -2.0, 0.5, 0.1, 0.2;
  }

  struct Outcome {
    VecN known, unknown;
    AdaptiveState<N, P> after_known, after_unknown;
  };
  Outcome Try(const std::string& name) {
    const LawId id = reed::internal::LawIdOf(name);
    const Gains<N, P> gains = GainsFrom<N, P>(scenario.control, scenario.arm, arm, id);
    const auto& law = LawBank<N, P>::Get(id);
    const control::Reference<N> desired;
    const Measurement<N> measured;
    const LawInput<N, P> in{gains, arm,     aux, s,        regressor,           JtF_d, r,      1e-3,
                            0.0,   desired, 0.0, measured, ForceSource::kKnown, true,  nullptr};
    Outcome out{VecN::Zero(), VecN::Zero(), AdaptiveState<N, P>(gains), AdaptiveState<N, P>(gains)};
    out.known = law.known(in, out.after_known);
    out.unknown = law.unknown(in, out.after_unknown);
    law.adapt_known(in, out.after_known);
    law.adapt_unknown(in, out.after_unknown);
    return out;
  }
  VecN Model(const VecP& p) const {
    return arm.rotor_inertia.cwiseProduct(aux.v_dot) + regressor.Y * p + regressor.f_known;
  }
  VecN Kd(double scale = 1.0) const {
    VecN K_d;
    K_d << 45.0, 41.0, 24.0, 7.5, 4.2;
    return scale * K_d;
  }

  model::ArmModel<N, P> arm;
  ControllerConfig scenario;
  model::Kinematics<N> kin;
  control::Auxiliary<N> aux;
  VecN s, JtF_d, r;
  model::Regressor<N, P> regressor;
};

TEST_F(LawBankTest, AnUnknownNameIsNoLaw) {
  EXPECT_THROW(reed::internal::LawIdOf("sliding"), std::runtime_error);
}

TEST_F(LawBankTest, PdWithThePapersGainsKnowsNoModelAndNoForce) {
  const Outcome pd = Try("pd");
  EXPECT_LT((pd.known - 10.0 * s).norm(), 1e-12);
  EXPECT_EQ(pd.known, pd.unknown);
  EXPECT_LT((Try("pd_tuned").known - Kd().cwiseProduct(s)).norm(), 1e-12);
}

TEST_F(LawBankTest, FixedNominalIsTheModelWithItsStartAndLearnsNothing) {
  const Outcome fixed = Try("fixed_nominal");
  EXPECT_LT((fixed.known - (Model(arm.p_nominal) - JtF_d + Kd().cwiseProduct(s))).norm(), 1e-9);
  EXPECT_LT((fixed.unknown - (Model(arm.p_nominal) + Kd().cwiseProduct(s))).norm(), 1e-9);
  EXPECT_EQ(fixed.after_known.p_hat, arm.p_nominal);
}

TEST_F(LawBankTest, SeparatedStartsAsFixedNominalAndSubtractsTheObserverOnlyWhereTheForceIsUnknown) {
  const Outcome separated = Try("separated"), fixed = Try("fixed_nominal");
  EXPECT_LT((separated.known - fixed.known).norm(), 1e-12);
  EXPECT_LT((separated.unknown - (fixed.unknown - r)).norm(), 1e-12);
}

TEST_F(LawBankTest, SeparatedLearnsDownTheGradientInsideItsBoxes) {
  const AdaptiveState<N, P> x = Try("separated").after_known;
  const VecP gradient = regressor.Y.transpose() * control::DeadZone<N>(s, 0.003);
  for (int k = 0; k < P; ++k) {
    EXPECT_NEAR(x.p_hat[k], std::clamp(arm.p_nominal[k] + 1e-3 * 5.0 * gradient[k], arm.p_lo[k], arm.p_hi[k]),
                1e-12);
  }
  EXPECT_GT(x.sigma_0, 0.0);
  EXPECT_GT(x.sigma_1, 0.0);
  EXPECT_GE(x.kappa_hat.minCoeff(), 0.0);
}

TEST_F(LawBankTest, ThePrintedUnknownForceLawStartsWithoutDampingAndWithNegativeMasses) {
  const Outcome printed = Try("paper_printed");
  const VecP Yts = regressor.Y.transpose() * s;
  VecP eta_0;
  eta_0 << 0.8, 0.2, 0.2, 0.8, 0.8, 0.8;
  const VecP p_hat = -eta_0.cwiseProduct(Yts.cwiseSign());
  EXPECT_LT((printed.unknown - Model(p_hat)).norm(), 1e-9) << "no K_d s, sigma still zero";
  EXPECT_NEAR(printed.after_unknown.sigma_0, 0.015 * s.squaredNorm(), 1e-15);
  EXPECT_EQ(printed.after_unknown.sigma_0, printed.after_unknown.sigma_1) << "(40) and (41) print the same";
  EXPECT_LT((printed.after_known.eta_hat - 0.05 * Yts).norm(), 1e-12) << "(34) is a value, not a rate";
}

TEST_F(LawBankTest, ThePapersCorrectedLawHasItsGainsAndRates) {
  const Outcome corrected = Try("paper_corrected");
  EXPECT_LT((corrected.known - (Model(arm.p_nominal) - JtF_d + 10.0 * s)).norm(), 1e-9);
  const VecP Yts = regressor.Y.transpose() * s;
  EXPECT_LT((corrected.after_known.p_hat - (arm.p_nominal + 1e-3 * 0.05 * Yts)).norm(), 1e-12);
  EXPECT_NEAR(corrected.after_unknown.sigma_1, 1e-3 * 0.015 * s.lpNorm<1>(), 1e-15);
  EXPECT_LT((corrected.after_unknown.eta_hat -
             AdaptiveState<N, P>(GainsFrom<N, P>(scenario.control, scenario.arm, arm, LawId::kPaperCorrected))
                 .eta_hat -
             1e-3 * 0.015 * Yts.cwiseAbs())
                .norm(),
            1e-12);
}

TEST_F(LawBankTest, ComputedTorqueIsTheModelAtItsAcceleration) {
  EXPECT_LT((Try("computed_torque").known - Model(arm.p_nominal)).norm(), 1e-9);
}

}  // namespace
}  // namespace reed::strategy
