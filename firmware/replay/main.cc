// reed_replay: a tape through the controller's own code. Cycle and loop are those of the firmware; clock, bus and the
// operator's stop are the tape's. Nothing waits: a minute of a run takes seconds.
//
//   TapeReader -> Player -> TapeClock, TapeTransport -> loop, Cycle -> ring -> Player -> TapeWriter
#include <cstdio>
#include <memory>

#include "options.h"
#include "player.h"
#include "reed/bus/codec/reed_codec.h"
#include "reed/config/controller/load_controller_config.h"
#include "reed/config/description/config_error.h"
#include "reed/firmware/cycle/make_cycle.h"
#include "reed/firmware/law_plugin/law_plugin.h"
#include "reed/firmware/loop/lockstep_loop.h"
#include "reed/firmware/loop/realtime_loop.h"
#include "reed/firmware/startup/checks.h"
#include "reed/firmware/startup/loop_options.h"
#include "reed/rt/program.h"

namespace reed {
namespace {

void RefuseAnotherArm(const tape::Header& tape, const ControllerConfig& config) {
  if (config.arm.dof() == tape.joints && config.arm.num_parameters() == tape.parameters) return;
  throw ConfigError("arm " + config.arm.name + " has " + std::to_string(config.arm.dof()) + " joints and " +
                    std::to_string(config.arm.num_parameters()) + " parameters, the tape's has " +
                    std::to_string(tape.joints) + " and " + std::to_string(tape.parameters) +
                    "; allowed: an arm with the same numbers");
}

int Run(const ReplayOptions& options) {
  tape::TapeReader reader(options.tape);
  const ControllerConfig config = LoadControllerConfig(options.config, options.load);
  RefuseAnotherArm(reader.header(), config);
  const LoopOptions loop = LoopOptionsFrom(WithBudgets(config));
  const std::unique_ptr<LawPlugin> plugin = OpenLaw(options.law, config);

  tape::TapeWriter out(options.out, reader.header());
  telemetry::SnapshotRing ring(4);
  Player player(reader, loop.first_cycle, ring, out);
  TapeClock clock(player);
  bus::ReedControllerCodec codec;
  TapeTransport bus(player, codec);
  const std::unique_ptr<CycleBase> cycle =
      MakeCycle(config, bus, reader.header().enable, plugin != nullptr ? &plugin->law() : nullptr);
  TapedCycle taped(*cycle, player, bus);

  if (reader.header().clock == "lockstep")
    LockstepLoop(clock, loop.first_cycle, taped, ring).Run(player.stop());
  else
    RealtimeLoop(clock, loop, taped, ring).Run(player.stop());
  player.Drain();
  out.End();
  if (const telemetry::SinkReport& report = out.report(); !report.problem.empty())
    throw rt::Failure(report.Loss("records"), rt::kDied);
  std::printf("replayed %lld cycles\n", static_cast<long long>(player.cycles()));
  return 0;
}

}  // namespace
}  // namespace reed

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_replay", [&] { return reed::Run(reed::ParseReplayOptions(argc, argv)); });
}
