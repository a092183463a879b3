// ns of the regressor Y(q, qd, v, v_dot), with the kinematics it needs: a5 and a7, from config/arms.
#include <cstdlib>

#include "bench/inputs.h"
#include "bench/stopwatch.h"
#include "config/schema/arm_file.h"
#include "firmware/model/regressor.h"

namespace reed::bench {
namespace {

template <int N, int P>
void Run(const char* arm_name, const char* label) {
  const model::ArmModel<N, P> arm(LoadArm(arm_name));
  const auto inputs = Inputs<N>();
  model::Kinematics<N> kin;
  model::Regressor<N, P> regressor;
  Print(label, Measure([&](int k) {
          const Input<N>& in = inputs[static_cast<std::size_t>(k) & (inputs.size() - 1)];
          model::ForwardKinematics<N, P>(arm, in.q, in.qd, kin);
          model::ComputeRegressor<N, P>(arm, kin, in.v, in.v_dot, regressor);
          Keep(regressor);
        }));
}

}  // namespace
}  // namespace reed::bench

/// `reed_bench_regressor N` runs N plain regressors of a5 instead: callgrind counts those.
int main(int argc, char** argv) {
  if (argc > 1) {
    const reed::model::ArmModel<5, 7> arm(reed::LoadArm("a5"));
    const auto inputs = reed::bench::Inputs<5>();
    reed::model::Kinematics<5> kin;
    reed::model::Regressor<5, 7> regressor;
    for (int k = 0, end = std::atoi(argv[1]); k < end; ++k) {
      const auto& in = inputs[static_cast<std::size_t>(k) & (inputs.size() - 1)];
      reed::model::ForwardKinematics<5, 7>(arm, in.q, in.qd, kin);
      reed::model::ComputeRegressor<5, 7>(arm, kin, in.v, in.v_dot, regressor);
      reed::bench::Keep(regressor);
    }
    return 0;
  }
  reed::bench::Run<5, 7>("a5", "regressor_a5");
  reed::bench::Run<7, 7>("a7", "regressor_a7");
}
