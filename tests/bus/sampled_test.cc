#include "bus/sampled.h"

#include <gtest/gtest.h>

namespace reed::bus {
namespace {

TEST(Sampled, NeverReceivedIsNeverFreshHoweverLongOneIsWillingToWait) {
  Sampled<double> value;
  EXPECT_FALSE(value.IsFresh(Sampled<double>::kNever));
  value.Age();
  EXPECT_EQ(value.age_cycles(), Sampled<double>::kNever);
  EXPECT_EQ(value.e2e(), E2eState::kNone);
}

TEST(Sampled, AgesByOnePerCycleAndStartsAnewWithEachValue) {
  Sampled<double> value;
  value.Set(1.5, E2eState::kOk);
  EXPECT_TRUE(value.IsFresh());
  value.Age();
  value.Age();
  EXPECT_EQ(value.age_cycles(), 2U);
  EXPECT_FALSE(value.IsFresh(1));
  EXPECT_TRUE(value.IsFresh(2));
  value.Set(2.5, E2eState::kOkSomeLost);
  EXPECT_EQ(value.age_cycles(), 0U);
  EXPECT_EQ(value.value(), 2.5);
  EXPECT_EQ(value.e2e(), E2eState::kOkSomeLost);
}

TEST(Sampled, RefusedFrameKeepsValueAndAge) {
  Sampled<double> value;
  value.Set(1.5, E2eState::kOk);
  value.Age();
  value.Refuse(E2eState::kCrcError);
  EXPECT_EQ(value.value(), 1.5);
  EXPECT_EQ(value.age_cycles(), 1U);
  EXPECT_EQ(value.e2e(), E2eState::kCrcError);
}

}  // namespace
}  // namespace reed::bus
