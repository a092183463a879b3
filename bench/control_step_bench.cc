// ns of the whole control step of a5. `reed_bench_step N` runs N plain steps instead: callgrind counts those.
#include <cstdlib>

#include "bench/control_step.h"
#include "bench/stopwatch.h"

int main(int argc, char** argv) {
  reed::bench::ControlStep<5, 7> step(reed::LoadScenario("press_known"));
  if (argc > 1) {
    for (int k = 0, end = std::atoi(argv[1]); k < end; ++k) reed::bench::Keep(step.Run(k));
    return 0;
  }
  reed::bench::Print("step_a5", reed::bench::Measure([&](int k) { reed::bench::Keep(step.Run(k)); }));
}
