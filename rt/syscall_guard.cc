#include "reed/rt/syscall_guard.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace reed::rt {
namespace {

constexpr std::array kAllowed{
    __NR_clock_nanosleep, __NR_sendmmsg,  __NR_recvmmsg,     __NR_io_uring_enter, __NR_ppoll,
    __NR_clock_gettime,   __NR_getrusage, __NR_rt_sigreturn, __NR_exit,           __NR_restart_syscall};

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
#error "name the architecture, or the filter would read foreign numbers"
#endif

constexpr sock_filter Statement(std::uint16_t code, std::uint32_t value) { return {code, 0, 0, value}; }

/// Load the architecture, kill if foreign; load the number; one comparison per allowed call; kill.
constexpr auto Program() {
  constexpr std::size_t kCalls = kAllowed.size();
  std::array<sock_filter, kCalls + 6> program{};
  std::size_t n = 0;
  program[n++] = Statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch));
  program[n++] = {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, kArchitecture};
  program[n++] = Statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  program[n++] = Statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (std::size_t i = 0; i < kCalls; ++i) {
    const auto to_allow = static_cast<std::uint8_t>(kCalls - i);  // over the rest and the kill
    program[n++] = {BPF_JMP | BPF_JEQ | BPF_K, to_allow, 0, static_cast<std::uint32_t>(kAllowed[i])};
  }
  program[n++] = Statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  program[n++] = Statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  return program;
}

}  // namespace

bool ArmSyscallGuard() noexcept {
  static constexpr auto kProgram = Program();
  const sock_fprog filter{static_cast<unsigned short>(kProgram.size()),
                          const_cast<sock_filter*>(kProgram.data())};  // the kernel only reads it
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         syscall(__NR_seccomp, SECCOMP_SET_MODE_FILTER, 0, &filter) == 0;
}

void EndGuardedThread() noexcept {
  while (true) syscall(__NR_exit, 0);
}

}  // namespace reed::rt
