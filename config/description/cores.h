// The cores that [timing] leaves to the programs. Controller and plant work in turns, so by default they
// share one: a frame wakes its reader without waking a core, a pause of that core meets both alike, and the
// other cores are left to telemetry. RT: set-up only.
#pragma once

#include <sched.h>

#include "reed/config/description/timing_config.h"

namespace reed {

/// Core of the loop: timing.cpu, or the last one that this process may use.
inline int LoopCore(const TimingConfig& timing) {
  if (timing.cpu >= 0) return timing.cpu;
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  int last = 0;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &allowed)) last = core;
  }
  return last;
}

/// Core of the plant: timing.plant_cpu, or that of the loop.
inline int PlantCore(const TimingConfig& timing) {
  return timing.plant_cpu >= 0 ? timing.plant_cpu : LoopCore(timing);
}

}  // namespace reed
