// The controller on a bus that is open: cycle, recorder, loop, and what is said at the end. For the program
// that is alone on its side of the bus and for the one that holds both sides.
#pragma once

#include <string>

#include "reed/bus/transport/transport.h"
#include "reed/config/controller/controller_config.h"
#include "reed/firmware/loop/loop.h"
#include "reed/rt/clock_kind.h"
#include "reed/rt/usage.h"

namespace reed {

struct ControlOptions {
  rt::ClockKind clock = rt::ClockKind::kRealtime;
  std::string law;      // LIB.so[:ARGUMENT]; empty: the scenario's
  std::string log;      // LCM event log
  std::string candump;  // CAN log
  std::string tape;     // what a replay needs
  std::string commit;   // for the tape: of the tree that the programs were built from, as far as it is known
  bool enable = false;  // the operator's wish to open the brakes
  bool quiet = false;
  bool lcm = true;
  bool lock_memory = true;  // lockstep may leave it unlocked
  bool seccomp = false;     // any system call that a cycle does not need ends the program
  bool host_pause = false;  // a bench's host may pause: what is missed meanwhile does not stop the arm
  /// What the loop's thread does for others inside the loop, counted by them; nullptr: nothing.
  const rt::Usage* for_others = nullptr;
};

/// The scenario's [timing] as the loop takes it; throws ConfigError when its frames do not fit the wire.
LoopOptions PlanLoop(const ControllerConfig& scenario);

/// config_text: the scenario as the tape keeps it; empty without a tape. Runs the scenario to its end and returns the exit
/// status: 0, 1 when the arm stopped, 3 when the bus is lost. Throws, before anything moves, what bad input throws.
int ControlArm(const ControlOptions& options, const ControllerConfig& scenario,
               const std::string& config_text, const LoopOptions& loop, bus::Transport& transport);

}  // namespace reed
