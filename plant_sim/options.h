// The command line of reed_plant_sim. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/description/load_options.h"

namespace reed::plant {

enum class ClockKind { kWall, kLockstep };

struct Options {
  std::string config;
  LoadOptions load;
  std::string bus = "socketcan:vcan0";
  ClockKind clock = ClockKind::kWall;
  std::string log;
  double duration_s = 0.0;  // of plant time; 0: until a signal
  bool quiet = false;
  bool lcm = true;
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to run.
Options ParseOptions(int argc, char** argv);

}  // namespace reed::plant
