// The command line of reed_plant_sim. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/description/load_options.h"
#include "reed/rt/clock_kind.h"

namespace reed::plant {

struct Options {
  std::string config;
  LoadOptions load;
  std::string bus = "socketcan:vcan0";
  rt::ClockKind clock = rt::ClockKind::kRealtime;
  std::string log;
  double duration_s = 0.0;  // of plant time; 0: until a signal
  bool quiet = false;
  bool lcm = true;
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to run.
Options ParseOptions(int argc, char** argv);

}  // namespace reed::plant
