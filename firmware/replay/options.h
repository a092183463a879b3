// The command line of reed_replay.
#pragma once

#include <string>

#include "reed/config/description/load_options.h"

namespace reed {

struct ReplayOptions {
  std::string tape, out;
  std::string config;  // as the tape holds it
  LoadOptions load;
  std::string law;  // LIB.so[:ARGUMENT]; empty: the scenario's
};

/// Prints help or one error line and ends the process (0 or 2) when there is nothing to replay.
ReplayOptions ParseReplayOptions(int argc, char** argv);

}  // namespace reed
