// (47): a body of constant inertia under a step of torque that nobody announced.
#include "reed/core/estimate/observer.h"

#include <gtest/gtest.h>

namespace reed::control {
namespace {

constexpr double kK_o = 80.0, kT = 1e-3, kStep = 2.5;

/// r after k cycles of the step: momentum grows by exactly T·step each cycle, the commanded torque is zero.
double ResponseAfter(int cycles) {
  MomentumObserver<1> observer(kK_o, kT);
  observer.Reset(Vec<1>::Zero());
  double p = 0.0;
  for (int k = 0; k < cycles; ++k) {
    p += kT * kStep;
    observer.Update(Vec<1>::Constant(p), Vec<1>::Zero());
  }
  return observer.r()[0];
}

TEST(MomentumObserver, AfterAStepReaches63PercentAtOneOverKoAnd95PercentAtThree) {
  const int one = 13;  // 12.5 cycles: between 12 and 13
  EXPECT_LT(ResponseAfter(one - 1), (1.0 - std::exp(-1.0)) * kStep);
  EXPECT_GT(ResponseAfter(one), (1.0 - std::exp(-1.0)) * kStep);
  EXPECT_LT(ResponseAfter(37), (1.0 - std::exp(-3.0)) * kStep);
  EXPECT_GT(ResponseAfter(38), (1.0 - std::exp(-3.0)) * kStep);
}

TEST(MomentumObserver, ItsPoleIsExpOfMinusKoT) {
  for (int k = 5; k < 60; ++k) {
    const double ratio = (kStep - ResponseAfter(k + 1)) / (kStep - ResponseAfter(k));
    EXPECT_NEAR(ratio, std::exp(-kK_o * kT), 1e-9) << k;
  }
}

TEST(MomentumObserver, WhatIsKnownIsNotObserved) {
  MomentumObserver<1> observer(kK_o, kT);
  observer.Reset(Vec<1>::Zero());
  double p = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double known = std::sin(0.1 * k);
    p += kT * known;
    observer.Update(Vec<1>::Constant(p), Vec<1>::Constant(known));
    EXPECT_NEAR(observer.r()[0], 0.0, 1e-12);
  }
}

TEST(MomentumObserver, AGapTeachesNothing) {
  MomentumObserver<1> observer(kK_o, kT);
  observer.Reset(Vec<1>::Zero());
  double p = 0.0;
  for (int k = 0; k < 400; ++k) {
    const bool gap = k == 300;  // five cycles at once
    p += (gap ? 5.0 : 1.0) * kT * kStep;
    if (gap)
      observer.Skip(Vec<1>::Constant(p));
    else
      observer.Update(Vec<1>::Constant(p), Vec<1>::Zero());
    if (k > 200) {
      EXPECT_NEAR(observer.r()[0], kStep, 1e-6) << k;
    }
  }
}

TEST(MomentumObserver, StartsFromAMovingArmWithoutADisturbance) {
  MomentumObserver<2> observer(kK_o, kT);
  observer.Reset(Vec<2>(3.0, -1.0));
  observer.Update(Vec<2>(3.0, -1.0), Vec<2>::Zero());
  EXPECT_EQ(observer.r().norm(), 0.0);
}

}  // namespace
}  // namespace reed::control
