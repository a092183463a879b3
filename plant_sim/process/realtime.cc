#include "reed/plant/process/realtime.h"

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>

#include "reed/config/description/cores.h"
#include "reed/plant/process/thread_rights.h"

namespace reed::plant {
namespace {

void CheckCore(const TimingConfig& timing) {
  const long cores = sysconf(_SC_NPROCESSORS_CONF);
  const int core = PlantCore(timing);
  if (core < cores) return;
  throw std::invalid_argument((timing.plant_cpu >= 0 ? "timing.plant_cpu = " : "timing.cpu = ") +
                              std::to_string(core) + ": allowed are the cores 0 to " +
                              std::to_string(cores - 1) + " of this machine, or -1 to leave the choice");
}

}  // namespace

std::vector<std::string> AskForRealtime(const TimingConfig& timing) {
  CheckCore(timing);
  std::vector<std::string> refused;
  // Every page now and later: a page fault in a step costs more than the step (mlockall(2), notes on real
  // time).
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    refused.push_back(std::string("memory not locked (") + ErrnoText() +
                      "); fix: ulimit -l unlimited, or memlock in /etc/security/limits.conf");
  }
  // Level with the loop: on one CPU neither interrupts the other, so an answer is complete before the loop
  // sees its first frame, and a command is recorded before the plant acts on it. Apart, each frame costs two
  // context switches.
  if (!RaiseTo(timing.priority)) {
    refused.push_back("SCHED_FIFO " + std::to_string(timing.priority) + " not granted (" + ErrnoText() +
                      "); fix: run as root, or rtprio 99 in /etc/security/limits.conf");
  }
  if (const int core = PlantCore(timing); !PinTo(core)) {
    refused.push_back(
        "core " + std::to_string(core) + " not granted (" + ErrnoText() +
        "); fix: a core that is online and in this container's cpuset, or timing.plant_cpu = -1");
  }
  return refused;
}

}  // namespace reed::plant
