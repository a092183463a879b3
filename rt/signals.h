// Signals as flags that a loop can read. RT: set-up only; the flag itself is safe to read.
#pragma once

#include <atomic>

namespace reed::rt {

/// From here on SIGINT, SIGTERM and, but for nohup, SIGHUP set the flag instead of ending the process. A system call that
/// waits returns.
const std::atomic<bool>& StopFlag();

}  // namespace reed::rt
