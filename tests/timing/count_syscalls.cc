// reed_count_syscalls PROGRAM ARGUMENT…: runs it and prints one JSON line per thread with the number of its
// system calls by number: {"thread": 1, "calls": {"299": 1000}}. By ptrace, so the kernel itself counts.
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <map>

namespace {

struct Thread {
  std::map<long, long> calls;
};

long NumberOfCall(pid_t thread) {
  __ptrace_syscall_info info{};
  ptrace(PTRACE_GET_SYSCALL_INFO, thread, sizeof info, &info);
  return info.op == PTRACE_SYSCALL_INFO_ENTRY ? static_cast<long>(info.entry.nr) : -1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const pid_t child = fork();
  if (child == 0) {
    ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    execvp(argv[1], argv + 1);
    _exit(127);
  }
  std::map<pid_t, Thread> threads;
  int status = 0, result = 1;
  waitpid(child, &status, 0);
  ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL);
  ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
  for (pid_t thread = 0; (thread = waitpid(-1, &status, __WALL)) > 0;) {
    if (WIFEXITED(status) || WIFSIGNALED(status)) {
      if (thread == child) result = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      continue;
    }
    long deliver = 0;
    const int signal = WSTOPSIG(status);
    if (signal == (SIGTRAP | 0x80)) {
      const long number = NumberOfCall(thread);
      if (number >= 0) ++threads[thread].calls[number];
    } else if (signal != SIGTRAP && signal != SIGSTOP) {
      deliver = signal;
    }
    ptrace(PTRACE_SYSCALL, thread, nullptr, deliver);
  }
  for (const auto& [id, thread] : threads) {
    std::printf("{\"thread\": %d, \"calls\": {", id);
    const char* comma = "";
    for (const auto& [number, count] : thread.calls) {
      std::printf("%s\"%ld\": %ld", comma, number, count);
      comma = ", ";
    }
    std::printf("}}\n");
  }
  return result;
}
