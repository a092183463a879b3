// The whole control step for REED_BENCH_JOINTS joints, one program per number: a step for 32 joints is larger
// than anything that an arm needs, and only built to be measured.
#include "reed/bench/chain.h"
#include "reed/bench/control_step.h"

int main(int argc, char** argv) {
  constexpr int N = REED_BENCH_JOINTS;
  const reed::bench::Stopwatch watch(argc, argv);
  reed::bench::ControlStep<N, N> step(reed::ControllerHalf(reed::bench::Swing(N)));
  watch.Measure("step_" + std::to_string(N), [&](int k) { reed::bench::Keep(step.Run(k)); });
}
