// Everything that the loop asks of the model, without the heap.
#include <gtest/gtest.h>

#include "reed/core/model/regressor.h"
#include "reed/core/model/static_deflection.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/model/states.h"
#include "reed/tests/support/no_alloc.h"

namespace reed::model {
namespace {

TEST(Model, OneCycleTouchesNoHeap) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  test::Draw draw(41);
  Kinematics<5> kin;
  Regressor<5, 6> regressor;
  for (int n = 0; n < 10; ++n) {
    const Vec<5> q = draw.Vector<5>(2.0), qd = draw.Vector<5>(2.0), v = draw.Vector<5>(2.0),
                 vd = draw.Vector<5>(5.0);
    Vec<5> sum;
    {
      const test::NoAlloc guard("the model's cycle");
      ForwardKinematics(arm, q, qd, kin);
      ComputeRegressor(arm, kin, v, vd, regressor);
      const Bodies<5> bodies = BodiesFor(arm, arm.p_nominal);
      const MomentumModel<5> momentum = GeneralisedMomentum(bodies, kin, arm.gravity);
      sum = regressor.f(arm.p_nominal) + momentum.momentum + momentum.free_rate +
            CompensateDeflection(arm, kin, bodies, Wrench{}).offset;
    }
    EXPECT_TRUE(sum.allFinite());
  }
}

}  // namespace
}  // namespace reed::model
