// The command line of reed_firmware. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/schema/scenario_file.h"
#include "reed/rt/clock_kind.h"

namespace reed {

struct Options {
  std::string config;
  LoadOptions load;
  std::string bus = "socketcan:vcan0";
  rt::ClockKind clock = rt::ClockKind::kRealtime;
  std::string law;      // LIB.so[:ARGUMENT]; empty: the scenario's
  std::string log;      // LCM event log
  std::string candump;  // CAN log
  bool enable = false;  // the operator's wish to open the brakes
  bool quiet = false;
  bool lcm = true;
  bool seccomp = false;     // any system call that a cycle does not need ends the program
  bool host_pause = false;  // a bench's host may pause: what is missed meanwhile does not stop the arm
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to run.
Options ParseOptions(int argc, char** argv);

}  // namespace reed
