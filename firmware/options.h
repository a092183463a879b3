// The command line of reed_firmware. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/description/load_options.h"

namespace reed {

enum class ClockKind { kWall, kLockstep };

struct Options {
  std::string config;
  LoadOptions load;
  std::string bus = "socketcan:vcan0";
  ClockKind clock = ClockKind::kWall;
  std::string log;      // LCM event log
  std::string candump;  // CAN log
  bool enable = false;  // the operator's wish to open the brakes
  bool quiet = false;
  bool lcm = true;
  bool seccomp = false;  // any system call that a cycle does not need ends the program
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to run.
Options ParseOptions(int argc, char** argv);

}  // namespace reed
