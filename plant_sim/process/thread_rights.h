// A core and a priority for the calling thread. RT: set-up only.
#pragma once

#include <sched.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace reed::plant {

/// False, with errno, when refused.
inline bool PinTo(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  return sched_setaffinity(0, sizeof cores, &cores) == 0;
}

/// SCHED_FIFO; false, with errno, when refused.
inline bool RaiseTo(int priority) {
  sched_param param{};
  param.sched_priority = priority;
  return sched_setscheduler(0, SCHED_FIFO, &param) == 0;
}

/// What the last system call complained of.
inline std::string ErrnoText() { return std::error_code(errno, std::generic_category()).message(); }

}  // namespace reed::plant
