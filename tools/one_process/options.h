// The command line of reed_one_process. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/description/load_options.h"
#include "reed/firmware/program/control.h"

namespace reed {

struct OneProcessOptions {
  std::string config;
  LoadOptions load;
  ControlOptions control;
  std::string plant_log;  // LCM event log of the plant
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to run.
OneProcessOptions ParseOneProcessOptions(int argc, char** argv);

}  // namespace reed
