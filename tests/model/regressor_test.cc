// (20), (27), (28) by identities that hold for every arm.
#include "reed/core/model/regressor.h"

#include <gtest/gtest.h>

#include "reed/core/model/dynamics.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

constexpr double kExact = 1e-9;
constexpr double kDifference = 1e-6;  // central differences of step h: h² and rounding/h

template <typename Size>
class Identities : public ::testing::Test {
 protected:
  using Joints = Vec<Size::kN>;
  const test::ModelArm<Size::kN, Size::kP> arm_{Size::Describe()};
  const Bodies<Size::kN> bodies_ = BodiesFor(arm_, arm_.p_true);
  test::Draw draw_{7};

  Kinematics<Size::kN> At(const Joints& q, const Joints& qd) const {
    Kinematics<Size::kN> kin;
    ForwardKinematics(arm_, q, qd, kin);
    return kin;
  }
};

struct A5 {
  static constexpr int kN = 5, kP = 6;
  static ArmDescription Describe() { return test::ArmA5(); }
};
struct A7 {
  static constexpr int kN = 7, kP = 7;
  static ArmDescription Describe() { return test::ArmA7(); }
};
struct P2 {
  static constexpr int kN = 2, kP = 1;
  static ArmDescription Describe() { return test::ArmP2(); }
};
struct Skew {
  static constexpr int kN = 6, kP = 4;
  static ArmDescription Describe() { return test::SkewArm(); }
};
using Arms = ::testing::Types<A5, A7, P2, Skew>;
TYPED_TEST_SUITE(Identities, Arms);

TYPED_TEST(Identities, YpIsMvPlusCvPlusGPlusFriction) {  // (27) = (28)
  constexpr int N = TypeParam::kN, P = TypeParam::kP;
  for (int n = 0; n < 300; ++n) {
    const auto kin = this->At(this->draw_.template Vector<N>(3.0), this->draw_.template Vector<N>(3.0));
    const Vec<N> v = this->draw_.template Vector<N>(3.0), v_dot = this->draw_.template Vector<N>(9.0);
    Regressor<N, P> regressor;
    ComputeRegressor(this->arm_, kin, v, v_dot, regressor);
    const Vec<N> f = MassMatrix(this->bodies_, kin) * v_dot + CoriolisMatrix(this->bodies_, kin) * v +
                     GravityTorque(this->bodies_, kin, this->arm_.gravity) +
                     ViscousFriction(this->arm_, this->arm_.p_true).cwiseProduct(v);
    EXPECT_LT((regressor.f(this->arm_.p_true) - f).norm(), kExact * (1.0 + f.norm()));
  }
}

TYPED_TEST(Identities, YIsLinearInTheParametersAndNotOnlyRightAtTheTruth) {  // (28)
  constexpr int N = TypeParam::kN, P = TypeParam::kP;
  const auto kin = this->At(this->draw_.template Vector<N>(3.0), this->draw_.template Vector<N>(3.0));
  const Vec<N> v = this->draw_.template Vector<N>(3.0), v_dot = this->draw_.template Vector<N>(9.0);
  Regressor<N, P> regressor;
  ComputeRegressor(this->arm_, kin, v, v_dot, regressor);
  for (int n = 0; n < 50; ++n) {
    const Vec<P> p = this->draw_.template Vector<P>(2.0);
    const Vec<N> f = PolarisedTorque(BodiesFor(this->arm_, p), kin, v, v_dot, this->arm_.gravity) +
                     ViscousFriction(this->arm_, p).cwiseProduct(v);
    EXPECT_LT((regressor.f(p) - f).norm(), kExact * (1.0 + f.norm()));
  }
}

TYPED_TEST(Identities, MdotMinusTwoCIsSkew) {
  constexpr int N = TypeParam::kN;
  constexpr double h = 1e-5;
  for (int n = 0; n < 50; ++n) {
    const Vec<N> q = this->draw_.template Vector<N>(3.0), qd = this->draw_.template Vector<N>(2.0);
    const auto kin = this->At(q, qd);
    const Mat<N, N> C = CoriolisMatrix(this->bodies_, kin);
    // C is linear in q̇ and its column j for q̇ = e_k is the Christoffel symbol: exact Ṁ = Σ q̇_k (C_k + C_kᵀ)
    // ...
    Mat<N, N> M_dot = C + C.transpose();
    // ... which must be the derivative of M along the motion.
    const Mat<N, N> difference = (MassMatrix(this->bodies_, this->At(q + h * qd, qd)) -
                                  MassMatrix(this->bodies_, this->At(q - h * qd, qd))) /
                                 (2.0 * h);
    EXPECT_LT((M_dot - difference).norm(), kDifference * (1.0 + M_dot.norm()));
    const Vec<N> x = this->draw_.template Vector<N>(1.0);
    EXPECT_NEAR(x.dot((M_dot - 2.0 * C) * x), 0.0, kExact);
  }
}

TYPED_TEST(Identities, CIsTheChristoffelMatrixOfM) {
  constexpr int N = TypeParam::kN;
  constexpr double h = 1e-5;
  const Vec<N> q = this->draw_.template Vector<N>(3.0), qd = this->draw_.template Vector<N>(2.0);
  std::vector<Mat<N, N>> dM;  // ∂M/∂q_k
  for (int k = 0; k < N; ++k) {
    const Vec<N> step = h * Vec<N>::Unit(k);
    dM.push_back((MassMatrix(this->bodies_, this->At(q + step, qd)) -
                  MassMatrix(this->bodies_, this->At(q - step, qd))) /
                 (2.0 * h));
  }
  const Mat<N, N> C = CoriolisMatrix(this->bodies_, this->At(q, qd));
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) {
      double c = 0.0;
      for (int k = 0; k < N; ++k) {
        const auto at = [&dM](int m) -> const Mat<N, N>& { return dM[static_cast<std::size_t>(m)]; };
        c += 0.5 * (at(k)(i, j) + at(j)(i, k) - at(i)(j, k)) * qd(k);
      }
      EXPECT_NEAR(C(i, j), c, kDifference * (1.0 + C.norm()));
    }
  }
}

TYPED_TEST(Identities, EnergyRateIsPower) {
  // d/dt (T + V) = q̇ᵀ τ. T + V is a function of q and q̇: its rate is ½ q̇ᵀ Ṁ q̇ + q̇ᵀ M q̈ + ∂V/∂q q̇.
  constexpr int N = TypeParam::kN;
  for (int n = 0; n < 100; ++n) {
    const Vec<N> qdd = this->draw_.template Vector<N>(9.0);
    const auto kin = this->At(this->draw_.template Vector<N>(3.0), this->draw_.template Vector<N>(2.0));
    const Mat<N, N> M = MassMatrix(this->bodies_, kin), C = CoriolisMatrix(this->bodies_, kin);
    const double rate = 0.5 * kin.qd.dot((C + C.transpose()) * kin.qd) + kin.qd.dot(M * qdd) +
                        kin.qd.dot(GravityTorque(this->bodies_, kin, this->arm_.gravity));
    const double power = kin.qd.dot(InverseDynamics(this->bodies_, kin, qdd, this->arm_.gravity));
    EXPECT_NEAR(rate, power, kExact * (1.0 + std::abs(power)));
    EXPECT_NEAR(KineticEnergy(this->bodies_, kin), 0.5 * kin.qd.dot(M * kin.qd), kExact);
  }
}

TYPED_TEST(Identities, GravityTorqueIsTheGradientOfPotentialEnergy) {
  constexpr int N = TypeParam::kN;
  constexpr double h = 1e-5;
  const Vec<N> q = this->draw_.template Vector<N>(3.0), zero = Vec<N>::Zero();
  const Vec<N> G = GravityTorque(this->bodies_, this->At(q, zero), this->arm_.gravity);
  for (int i = 0; i < N; ++i) {
    const Vec<N> step = h * Vec<N>::Unit(i);
    const double slope = (PotentialEnergy(this->bodies_, this->At(q + step, zero), this->arm_.gravity) -
                          PotentialEnergy(this->bodies_, this->At(q - step, zero), this->arm_.gravity)) /
                         (2.0 * h);
    EXPECT_NEAR(G(i), slope, kDifference * (1.0 + G.norm()));
  }
}

TYPED_TEST(Identities, MassMatrixIsPositiveDefinite) {
  constexpr int N = TypeParam::kN;
  for (int n = 0; n < 100; ++n) {
    const auto kin = this->At(this->draw_.template Vector<N>(3.0), Vec<N>::Zero());
    const Mat<N, N> M = MassMatrix(this->bodies_, kin);
    const Vec<N> x = this->draw_.template Vector<N>(1.0);
    EXPECT_GT(x.dot(M * x), 0.0);
    EXPECT_EQ((M - M.transpose()).norm(), 0.0);
  }
}

}  // namespace
}  // namespace reed::model
