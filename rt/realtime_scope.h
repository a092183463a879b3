// What the loop's thread requests of the machine, for the lifetime of the object: no page faults, priority, its
// own core. Whatever is refused is in the report with the reason and the fix, never ignored. RT: set-up only.
#pragma once

#include <sched.h>

#include <string>
#include <vector>

namespace reed::rt {

struct RealtimeOptions {
  int priority = 80;                   // SCHED_FIFO 1 … 99; 0: stay an ordinary thread
  int cpu = -1;                        // core to pin the thread to, -1: none
  bool lock_memory = true;             // no page of the program leaves memory
  bool lock_later_pages = false;       // nor any that comes later; for a program that goes on allocating
  const char* cpu_key = "timing.cpu";  // where the core was asked for
};

/// One request and its answer.
struct Grant {
  bool asked = false;
  bool granted = false;
  std::string problem;  // why not, empty when granted or not asked
  std::string fix;      // what to type or change
};

struct RealtimeReport {
  Grant memory;                     // mlockall
  Grant fifo;                       // SCHED_FIFO
  Grant affinity;                   // pinned to the core
  std::string scheduler = "other";  // "fifo:80" or "other", as in run_t
  int cpu = -1;                     // the core it is pinned to, -1: none

  /// One line per refused request: what, why, fix.
  std::vector<std::string> Complaints() const;
};

/// Maps the stack below the caller, so that the loop finds its pages. The scope does it for its own thread; a
/// thread that is started inside the scope has another stack.
void PrefaultStack() noexcept;

/// Applies to the calling thread (memory: to the process). Threads started inside the scope inherit priority
/// and core, so ordinary threads are started before it. The destructor, on the same thread, puts everything
/// back.
class RealtimeScope {
 public:
  /// @throws std::invalid_argument for a core that does not exist or a priority outside 0 … 99: that is a
  /// configuration error and not a refusal of the machine.
  explicit RealtimeScope(const RealtimeOptions& options);
  ~RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

  const RealtimeReport& report() const noexcept { return report_; }

 private:
  void Pin(int cpu);
  void Raise(int priority);
  void Lock(bool later_pages_too);

  RealtimeReport report_;
  cpu_set_t old_cpus_{};
  int old_policy_ = SCHED_OTHER;
  sched_param old_param_{};
  int old_timer_slack_ns_ = -1;
};

}  // namespace reed::rt
