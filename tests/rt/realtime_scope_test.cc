#include "reed/rt/realtime_scope.h"

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "reed/rt/usage.h"

namespace reed::rt {
namespace {

/// Runs `work` in a child that may have neither priority nor locked memory; returns what it wrote.
std::string InUnprivilegedChild(const std::function<std::string()>& work) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_RTPRIO, &none);
    setrlimit(RLIMIT_MEMLOCK, &none);
    if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) _exit(1);
    const std::string said = work();
    _exit(write(pipe_ends[1], said.data(), said.size()) < 0 ? 1 : 0);
  }
  close(pipe_ends[1]);
  std::string said;
  char chunk[512];
  for (ssize_t n = 0; (n = read(pipe_ends[0], chunk, sizeof chunk)) > 0;) {
    said.append(chunk, static_cast<std::size_t>(n));
  }
  close(pipe_ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? said : "child died";
}

TEST(RealtimeScope, ReportsARefusedPriorityWithReasonAndFix) {
  const std::string said = InUnprivilegedChild([] {
    const RealtimeScope scope({.priority = 80, .cpu = -1, .lock_memory = false});
    const RealtimeReport& report = scope.report();
    std::string lines = report.scheduler + "|" + (report.fifo.granted ? "granted" : "refused");
    for (const std::string& line : report.Complaints()) lines += "|" + line;
    return lines;
  });
  EXPECT_EQ(
      said.rfind("other|refused|SCHED_FIFO 80 refused: Operation not permitted (rtprio limit 0); fix: ", 0),
      0U)
      << said;
  EXPECT_NE(said.find("rtprio 99"), std::string::npos) << "the fix names the limit to set: " << said;
}

#ifndef REED_SANITIZED  // these turn mlockall into nothing
TEST(RealtimeScope, ReportsRefusedMemoryLockWithReasonAndFix) {
  const std::string said = InUnprivilegedChild([] {
    const RealtimeScope scope({.priority = 0, .cpu = -1, .lock_memory = true});
    std::string lines = scope.report().memory.granted ? "granted" : "refused";
    for (const std::string& line : scope.report().Complaints()) lines += "|" + line;
    return lines;
  });
  EXPECT_EQ(said.rfind("refused|memory not locked: ", 0), 0U) << said;
  EXPECT_NE(said.find("memlock unlimited"), std::string::npos) << said;
}
#endif

/// From here on the kernel answers sched_setaffinity as it does for a core that is offline or in no cpuset of
/// ours.
void RefuseAffinity() {
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_sched_setaffinity, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{4, program};
  prctl(PR_SET_NO_NEW_PRIVS, 1UL, 0UL, 0UL, 0UL);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

TEST(RealtimeScope, ReportsACoreThatTheMachineDoesNotGive) {
  const std::string said = InUnprivilegedChild([] {
    RefuseAffinity();
    const RealtimeScope scope({.priority = 0, .cpu = 0, .lock_memory = false});
    std::string lines = std::to_string(scope.report().cpu);
    for (const std::string& line : scope.report().Complaints()) lines += "|" + line;
    return lines;
  });
  EXPECT_EQ(said.rfind("-1|not pinned to core 0: Invalid argument; fix: ", 0), 0U) << said;
}

TEST(RealtimeScope, ACoreThatDoesNotExistIsAConfigurationError) {
  const int cores = static_cast<int>(sysconf(_SC_NPROCESSORS_CONF));
  for (const int cpu : {cores, 100'000, -2}) {
    try {
      const RealtimeScope scope({.priority = 0, .cpu = cpu, .lock_memory = false});
      FAIL() << "core " << cpu << " was accepted";
    } catch (const std::invalid_argument& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.rfind("timing.cpu = " + std::to_string(cpu) + ": allowed are the cores 0 to ", 0), 0U)
          << line;
      EXPECT_EQ(line.find('\n'), std::string::npos);
    }
  }
}

TEST(RealtimeScope, APriorityOutsideTheRangeIsAConfigurationError) {
  for (const int priority : {-1, 100}) {
    EXPECT_THROW(RealtimeScope({.priority = priority, .cpu = -1, .lock_memory = false}),
                 std::invalid_argument);
  }
}

TEST(RealtimeScope, NothingAskedIsNothingToComplainAbout) {
  const RealtimeScope scope({.priority = 0, .cpu = -1, .lock_memory = false});
  EXPECT_TRUE(scope.report().Complaints().empty());
  EXPECT_EQ(scope.report().scheduler, "other");
  EXPECT_FALSE(scope.report().memory.asked);
}

/// In a thread of its own, so that nothing sticks to the test runner.
TEST(RealtimeScope, EachRequestIsInForceInsideIfGrantedAndEverythingIsPutBackOutside) {
  std::thread([] {
    cpu_set_t before{}, inside{}, after{};
    sched_getaffinity(0, sizeof before, &before);
    int cpu = 0;
    while (!CPU_ISSET(static_cast<std::size_t>(cpu), &before)) ++cpu;
    {
      const RealtimeScope scope({.priority = 7, .cpu = cpu, .lock_memory = true});
      const RealtimeReport& report = scope.report();
      sched_getaffinity(0, sizeof inside, &inside);
      EXPECT_TRUE(report.affinity.granted) << "an allowed core is never refused";
      EXPECT_EQ(CPU_COUNT(&inside), 1);
      EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(cpu), &inside));
      EXPECT_EQ(sched_getscheduler(0), report.fifo.granted ? SCHED_FIFO : SCHED_OTHER);
      EXPECT_EQ(report.scheduler, report.fifo.granted ? "fifo:7" : "other");
      const std::size_t refused = (report.memory.granted ? 0U : 1U) + (report.fifo.granted ? 0U : 1U);
      EXPECT_EQ(report.Complaints().size(), refused);
    }
    sched_getaffinity(0, sizeof after, &after);
    EXPECT_TRUE(CPU_EQUAL(&before, &after));
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
  }).join();
}

#ifndef REED_SANITIZED  // touches shadow pages of its own for every page of stack
/// Reaches 256 KiB below its caller.
[[gnu::noinline]] void UseDeepStack() {
  [[maybe_unused]] volatile unsigned char deep[256 * 1024];
  for (std::size_t i = 0; i < sizeof deep; i += 1024) deep[i] = 1;
}

TEST(RealtimeScope, TheStackBelowTheLoopIsMappedBeforeTheLoopNeedsIt) {
  std::int64_t with_scope = -1, without = -1;
  std::thread([&] {
    const RealtimeScope scope({.priority = 0, .cpu = -1, .lock_memory = false});
    const Usage before = ThreadUsage();
    UseDeepStack();
    with_scope = (ThreadUsage() - before).page_faults();
  }).join();
  // A stack of its own: threads may inherit the cached, already mapped stack of an earlier one.
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  void* fresh = mmap(nullptr, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  madvise(fresh, 1 << 20, MADV_NOHUGEPAGE);
  pthread_attr_setstack(&attributes, fresh, 1 << 20);
  pthread_t thread{};
  const auto body = [](void* out) -> void* {
    const Usage before = ThreadUsage();
    UseDeepStack();
    *static_cast<std::int64_t*>(out) = (ThreadUsage() - before).page_faults();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, body, &without), 0);
  pthread_join(thread, nullptr);
  munmap(fresh, 1 << 20);
  EXPECT_EQ(with_scope, 0);
  EXPECT_GE(without, 60) << "the control: 64 pages, so the figure above is not zero by accident";
}
#endif

TEST(Usage, CountsThePagesThatAreTouchedFirst) {
  constexpr std::size_t kPages = 50, kPage = 4096;
  void* fresh = mmap(nullptr, kPages * kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  madvise(fresh, kPages * kPage, MADV_NOHUGEPAGE);
  auto* bytes = static_cast<volatile char*>(fresh);
  const Usage start = ThreadUsage();
  for (std::size_t i = 0; i < kPages; ++i) bytes[i * kPage] = 1;
  const Usage first = ThreadUsage();
  for (std::size_t i = 0; i < kPages; ++i) bytes[i * kPage] = 2;
  const Usage second = ThreadUsage();
  munmap(fresh, kPages * kPage);
  EXPECT_GE((first - start).page_faults(), static_cast<std::int64_t>(kPages));
  EXPECT_EQ((second - first).page_faults(), 0);
}

}  // namespace
}  // namespace reed::rt
