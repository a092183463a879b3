// Tells the machine from the controller: for how long this core ran nobody. A thread above both programs
// sleeps for a millisecond at a time; what it oversleeps by much, the machine was away: a hypervisor, the
// kernel, a higher priority or a debugger had it, and not a slow controller. The arm's clock leaves that time
// out. RT: set-up only, except stood_ns().
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace reed::plant {

class StallWatch {
 public:
  StallWatch() = default;
  ~StallWatch();
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;

  /// Watches this core at this priority of SCHED_FIFO: one above both programs, so that neither can be taken
  /// for the machine; without that right nothing is counted. To be called before memory is locked, which a
  /// new thread's stack may not survive. Returns why nothing is watched, with the fix, or "".
  std::string Start(int core, int priority);

  /// Time since the start in which the machine was away. RT: safe, any thread.
  std::int64_t stood_ns() const noexcept { return stood_ns_.load(std::memory_order_relaxed); }

 private:
  /// A stall is seen to within one beat. A thousand wake-ups of 4 us per second cost the core 0.4 %. No
  /// multiple of a usual period: else a run would meet the watch at the same place in every cycle, or in
  /// none.
  static constexpr std::int64_t kBeat_ns = 970'000;
  /// Oversleeping by less is a wake-up latency, and the programs' own business.
  static constexpr std::int64_t kStall_ns = 500'000;

  void Watch() noexcept;

  std::atomic<std::int64_t> stood_ns_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reed::plant
