// Real-time manners of the wall clock: priority, core, memory. RT: set-up only.
#pragma once

#include <string>
#include <vector>

#include "reed/config/description/timing_config.h"

namespace reed::plant {

/// Asks for SCHED_FIFO with the controller's priority, for its core (config/description/cores.h), and for locked
/// memory, for the calling thread. Returns one line, with the fix, for each thing that was not granted.
/// Throws std::invalid_argument for a core that does not exist: that is a configuration error.
std::vector<std::string> AskForRealtime(const TimingConfig& timing);

}  // namespace reed::plant
