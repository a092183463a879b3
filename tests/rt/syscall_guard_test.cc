// The filter in a child process: what a cycle needs passes, everything else ends the program.
#include "reed/rt/syscall_guard.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "reed/rt/clock.h"
#include "reed/rt/usage.h"

namespace reed::rt {
namespace {

/// Wait status of a child that arms the guard, does `act` and exits with 7.
template <typename Act>
int StatusOf(Act act) {
  const pid_t child = fork();
  if (child == 0) {
    if (!ArmSyscallGuard()) _exit(99);
    act();
    syscall(__NR_exit, 7);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

bool KilledBySigsys(int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS; }

TEST(SyscallGuard, LetsTheCyclesOwnCallsPass) {
  const int status = StatusOf([] {
    const MonotonicClock clock;
    clock.SleepUntil(clock.NowNs() + 100'000);
    ThreadUsage();
  });
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7) << status;
}

TEST(SyscallGuard, KillsAWriteAnAllocationAndALock) {
  EXPECT_TRUE(KilledBySigsys(StatusOf([] { syscall(__NR_write, 1, "", 0); })));
  EXPECT_TRUE(KilledBySigsys(StatusOf([] { syscall(__NR_brk, 0); })));
  EXPECT_TRUE(KilledBySigsys(StatusOf([] { syscall(__NR_mmap, 0, 4096, 0, 0x22, -1, 0); })));
  EXPECT_TRUE(KilledBySigsys(StatusOf([] { syscall(__NR_futex, 0, 1, 0, 0, 0, 0); })));
  EXPECT_TRUE(KilledBySigsys(StatusOf([] { syscall(__NR_getpid); })));
}

TEST(SyscallGuard, GuardsItsOwnThreadOnlyAndTheThreadCanBeJoined) {
  bool armed = false;
  std::thread guarded([&] {
    armed = ArmSyscallGuard();
    EndGuardedThread();
  });
  guarded.join();
  EXPECT_TRUE(armed);
  EXPECT_GT(syscall(__NR_getpid), 0) << "this thread is as free as before";
}

}  // namespace
}  // namespace reed::rt
