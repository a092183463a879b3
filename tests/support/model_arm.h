// The controller's model of an arm together with the truth that tests compare it with.
#pragma once

#include "reed/config/schema/halves.h"
#include "reed/firmware/setup/arm_model.h"

namespace reed::test {

template <int N, int P>
struct ModelArm : model::ArmModel<N, P> {
  explicit ModelArm(const ArmDescription& arm)
      : model::ArmModel<N, P>(model::ArmModelFrom<N, P>(NominalOf(arm))), p_true(model::Vec<P>::Zero()) {
    for (int k = 0; k < arm.num_parameters(); ++k)
      p_true[k] = arm.parameters[static_cast<std::size_t>(k)].truth;
  }

  model::Vec<P> p_true;
};

}  // namespace reed::test
