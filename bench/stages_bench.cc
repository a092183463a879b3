// Every stage of a5's control step and the whole of it, scenario press_known.
#include "reed/bench/codec_cycle.h"
#include "reed/bench/control_step.h"
#include "reed/bench/stages.h"
#include "reed/config/controller/load_controller_config.h"

int main(int argc, char** argv) {
  const reed::bench::Stopwatch watch(argc, argv);
  const reed::ControllerConfig scenario = reed::LoadControllerConfig("press_known");
  reed::bench::Stages<5, 7> stages(scenario);
  watch.Measure("kinematics", [&](int k) { stages.Kinematics(k); });
  watch.Measure("static_deflection", [&](int k) { stages.StaticDeflection(k); });
  watch.Measure("regressor", [&](int k) { stages.Regressor(k); });
  watch.Measure("law", [&](int k) { stages.Law(k); });
  watch.Measure("observer", [&](int k) { stages.Observer(k); });
  reed::bench::CodecCycle codec;
  watch.Measure("codec", [&](int k) { codec.Run(k); });
  reed::bench::ControlStep<5, 7> step(scenario);
  watch.Measure("step", [&](int k) { reed::bench::Keep(step.Run(k)); });
}
