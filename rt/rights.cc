#include "reed/rt/rights.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>

namespace reed::rt {
namespace {

/// Raises the soft limit to the hard one, so that the machine grants all that it may.
void RaiseSoftLimit(__rlimit_resource resource) noexcept {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(resource, &limit);
}

}  // namespace

bool PinTo(int core) noexcept {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  return sched_setaffinity(0, sizeof cores, &cores) == 0;
}

bool RaiseTo(int priority) noexcept {
  RaiseSoftLimit(RLIMIT_RTPRIO);
  sched_param param{};
  param.sched_priority = priority;
  return sched_setscheduler(0, SCHED_FIFO, &param) == 0;
}

bool LockMemory(bool later_pages_too) noexcept {
  RaiseSoftLimit(RLIMIT_MEMLOCK);
  return mlockall(later_pages_too ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0;
}

}  // namespace reed::rt
