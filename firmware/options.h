// The command line of reed_firmware. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/description/load_options.h"
#include "reed/firmware/program/control.h"

namespace reed {

struct Options {
  std::string config;
  LoadOptions load;
  std::string bus = "socketcan:vcan0";
  ControlOptions control;
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to run.
Options ParseOptions(int argc, char** argv);

}  // namespace reed
