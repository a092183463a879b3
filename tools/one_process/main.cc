// reed_one_process: controller and simulated arm in one process, in lockstep. The two meet here on purpose
// and only here: each is built from its own half, and all that passes between them is frames.
//
//   ControlArm (firmware/program) -> MemoryWire -> PlantSide -> LockstepEndpoint (plant_sim/endpoint)
#include "options.h"
#include "plant_side.h"
#include "reed/config/controller/load_controller_config.h"
#include "reed/config/plant/load_plant_config.h"
#include "reed/plant/program/conclusion.h"
#include "reed/plant/record/publisher.h"
#include "reed/rt/program.h"
#include "reed/rt/signals.h"
#include "reed/rt/thread_stack.h"

namespace reed {
namespace {

int Run(OneProcessOptions options) {
  rt::UseSmallThreadStacks();
  const ControllerConfig scenario = LoadControllerConfig(options.config, options.load);
  const LoopOptions loop = PlanLoop(scenario);
  const bool tape = !options.control.tape.empty();
  const bool quiet = options.control.quiet;

  bus::MemoryWire wire;
  plant::Publisher publisher(
      {options.plant_log, options.control.lcm, !quiet, plant::WhenFull::kWait, &rt::StopFlag()});
  PlantSide side(LoadPlantConfig(options.config, options.load), wire, publisher);
  options.control.for_others = &side.usage();

  const int controller =
      ControlArm(options.control, scenario, tape ? TextOf(scenario) : std::string(), loop, wire.controller);
  side.Rethrow();
  const int plant = plant::Conclude(side.endpoint(), publisher, quiet);
  return plant != 0 ? plant : controller;
}

}  // namespace
}  // namespace reed

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_one_process",
                              [&] { return reed::Run(reed::ParseOneProcessOptions(argc, argv)); });
}
