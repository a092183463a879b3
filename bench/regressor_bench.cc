// The regressor Y(q, qd, v, v_dot) of a5 and a7, with the kinematics it needs.
#include "reed/bench/inputs.h"
#include "reed/config/schema/arm_file.h"
#include "reed/config/schema/halves.h"
#include "reed/core/model/regressor.h"
#include "reed/firmware/setup/arm_model.h"

namespace reed::bench {
namespace {

template <int N, int P>
void Run(const Stopwatch& watch, const char* arm_name) {
  const model::ArmModel<N, P> arm = model::ArmModelFrom<N, P>(NominalOf(LoadArm(arm_name)));
  const Inputs<N> inputs;
  model::Kinematics<N> kin;
  model::Regressor<N, P> regressor;
  watch.Measure(std::string("regressor_") + arm_name, [&](int k) {
    const Input<N>& in = inputs[k];
    model::ForwardKinematics<N, P>(arm, in.q, in.qd, kin);
    model::ComputeRegressor<N, P>(arm, kin, in.v, in.v_dot, regressor);
    Keep(regressor);
  });
}

}  // namespace
}  // namespace reed::bench

int main(int argc, char** argv) {
  const reed::bench::Stopwatch watch(argc, argv);
  reed::bench::Run<5, 7>(watch, "a5");
  reed::bench::Run<7, 7>(watch, "a7");
}
