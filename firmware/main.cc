// reed_firmware: the controller. First everything is read, checked, allocated; then the loop runs in the
// real-time scope; then the books are closed.
//
//   SYNC -> ArmBus -> Separated strategy -> Limits -> COMMAND
//             `-> Snapshot -> ring -> Recorder (own thread) -> LCM, event log, candump, tape
#include <memory>

#include "options.h"
#include "reed/bus/codec/reed_codec.h"
#include "reed/bus/transport/open_transport.h"
#include "reed/config/controller/load_controller_config.h"
#include "reed/firmware/program/control.h"
#include "reed/firmware/startup/checks.h"
#include "reed/rt/program.h"
#include "reed/rt/thread_stack.h"

namespace reed {
namespace {

int Run(const Options& options) {
  rt::UseSmallThreadStacks();
  const ControllerConfig scenario = LoadControllerConfig(options.config, options.load);
  const LoopOptions loop = PlanLoop(scenario);
  const bool tape = !options.control.tape.empty();
  const std::unique_ptr<bus::Transport> transport = bus::OpenTransport(options.bus);
  if (options.control.clock == rt::ClockKind::kLockstep) RefuseLockstepOnRealDrives(*transport);
  if (options.control.host_pause) RefuseHostPauseOnRealDrives(*transport);
  bus::ReedControllerCodec listener;
  RefuseSecondController(*transport, listener);
  return ControlArm(options.control, scenario, tape ? TextOf(scenario) : std::string(), loop, *transport);
}

}  // namespace
}  // namespace reed

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_firmware", [&] { return reed::Run(reed::ParseOptions(argc, argv)); });
}
