// A core and a priority for the calling thread. RT: set-up only.
#pragma once

namespace reed::rt {

/// False, with errno, when refused.
bool PinTo(int core) noexcept;

/// SCHED_FIFO; false, with errno, when refused. Lifts the soft limit first, as far as the hard one allows.
bool RaiseTo(int priority) noexcept;

/// Every page that the process has now (and, if asked, every later one) stays in memory; false, with errno, when refused.
bool LockMemory(bool later_pages_too) noexcept;

}  // namespace reed::rt
