#include "reed/rt/realtime_scope.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "reed/rt/errno_text.h"
#include "reed/rt/rights.h"

namespace reed::rt {
namespace {

/// More than the deepest call of the loop needs, by far; a thread's default stack is 8 MiB.
constexpr std::size_t kStackBytes = std::size_t{512} * 1024;
constexpr std::size_t kSmallestPage = 4096;

std::string HardLimit(__rlimit_resource resource) {
  rlimit limit{};
  getrlimit(resource, &limit);
  return limit.rlim_max == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_max);
}

/// Of the program that runs, for a line to copy.
std::string ProgramPath() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).string();
}

void CheckOptions(const RealtimeOptions& options) {
  const long cores = sysconf(_SC_NPROCESSORS_CONF);
  if (options.cpu < -1 || options.cpu >= cores) {
    throw std::invalid_argument(options.cpu_key + (" = " + std::to_string(options.cpu)) +
                                ": allowed are the cores 0 to " + std::to_string(cores - 1) +
                                " of this machine, or -1 to leave the choice");
  }
  if (options.priority < 0 || options.priority > 99) {
    throw std::invalid_argument("timing.priority = " + std::to_string(options.priority) +
                                ": allowed are 1 to 99, or 0 for an ordinary thread");
  }
}

Grant Refused(std::string problem, std::string fix) {
  return {true, false, std::move(problem), std::move(fix)};
}

}  // namespace

/// Its own frame must really exist.
[[gnu::noinline]] void PrefaultStack() noexcept {
  [[maybe_unused]] volatile unsigned char stack[kStackBytes];
  for (std::size_t i = 0; i < kStackBytes; i += kSmallestPage) stack[i] = 0;
}

std::vector<std::string> RealtimeReport::Complaints() const {
  std::vector<std::string> lines;
  for (const Grant* grant : {&memory, &fifo, &affinity}) {
    if (grant->asked && !grant->granted) lines.push_back(grant->problem + "; fix: " + grant->fix);
  }
  return lines;
}

RealtimeScope::RealtimeScope(const RealtimeOptions& options) {
  CheckOptions(options);
  sched_getaffinity(0, sizeof old_cpus_, &old_cpus_);
  old_policy_ = sched_getscheduler(0);
  sched_getparam(0, &old_param_);
  // An ordinary thread's sleep may end 50 µs late to save wake-ups; a SCHED_FIFO thread's never does. Ask for
  // the same where priority is refused.
  old_timer_slack_ns_ = prctl(PR_GET_TIMERSLACK);
  prctl(PR_SET_TIMERSLACK, 1UL);

  // The order matters: the stack must be mapped before it is locked, and all of this is done before the
  // priority keeps others from their core.
  PrefaultStack();
  if (options.lock_memory) Lock(options.lock_later_pages);
  if (options.cpu >= 0) Pin(options.cpu);
  if (options.priority > 0) Raise(options.priority);
}

RealtimeScope::~RealtimeScope() {
  if (report_.fifo.granted) sched_setscheduler(0, old_policy_, &old_param_);
  if (report_.affinity.granted) sched_setaffinity(0, sizeof old_cpus_, &old_cpus_);
  if (report_.memory.granted) munlockall();
  if (old_timer_slack_ns_ > 0) prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(old_timer_slack_ns_));
}

void RealtimeScope::Lock(bool later_pages_too) {
  // The pages of now alone, for a loop that allocates nothing later on: locking later ones under a finite limit
  // makes the ordinary threads' allocations fail.
  if (LockMemory(later_pages_too)) {
    report_.memory = {true, true, {}, {}};
    return;
  }
  report_.memory = Refused(
      std::string("memory not locked: ") + ErrnoText() + " (limit " + HardLimit(RLIMIT_MEMLOCK) + " bytes)",
      "write \"* - memlock unlimited\" to /etc/security/limits.d/90-reed.conf and log in again, "
      "or: sudo setcap cap_sys_nice,cap_ipc_lock+ep " +
          ProgramPath());
}

void RealtimeScope::Pin(int cpu) {
  if (PinTo(cpu)) {
    report_.affinity = {true, true, {}, {}};
    report_.cpu = cpu;
    return;
  }
  report_.affinity =
      Refused("not pinned to core " + std::to_string(cpu) + ": " + ErrnoText(),
              "the core is offline or outside this container's cpuset; choose one that nproc counts, "
              "or set timing.cpu = -1");
}

void RealtimeScope::Raise(int priority) {
  if (RaiseTo(priority)) {
    report_.fifo = {true, true, {}, {}};
    report_.scheduler = "fifo:" + std::to_string(priority);
    return;
  }
  report_.fifo = Refused("SCHED_FIFO " + std::to_string(priority) + " refused: " + ErrnoText() +
                             " (rtprio limit " + HardLimit(RLIMIT_RTPRIO) + ")",
                         "write \"* - rtprio 99\" to /etc/security/limits.d/90-reed.conf and log in again, "
                         "or: sudo setcap cap_sys_nice,cap_ipc_lock+ep " +
                             ProgramPath());
}

}  // namespace reed::rt
