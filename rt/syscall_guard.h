// Lets the calling thread make only the system calls that a cycle is made of; any other ends the program with
// SIGSYS. A seccomp filter of this thread alone, and for good: a guarded thread ends with EndGuardedThread().
//
//   clock_nanosleep   the grid                        ppoll, recvmmsg   receive
//   sendmmsg          SYNC, command                   io_uring_enter    receive, both in one
//   getrusage         page faults, twice a run        clock_gettime     where the vDSO cannot serve it
//   exit              the thread's end                rt_sigreturn      the flag that SIGINT sets
//
// RT: safe after ArmSyscallGuard().
#pragma once

namespace reed::rt {

/// False with errno when the kernel refuses; then nothing is guarded.
bool ArmSyscallGuard() noexcept;

/// Ends the calling thread with one system call; nothing of it is destroyed, joining it works.
[[noreturn]] void EndGuardedThread() noexcept;

}  // namespace reed::rt
