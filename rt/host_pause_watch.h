// Measures for how long the host ran nothing on one core: a hypervisor, the kernel, a higher priority or a
// debugger had it. A thread above both programs sleeps for a millisecond at a time. What it oversleeps by much
// is a host pause; a busy program below it does not delay it. RT: set-up only, except paused_ns().
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace reed::rt {

class HostPauseWatch {
 public:
  HostPauseWatch() = default;
  ~HostPauseWatch();
  HostPauseWatch(const HostPauseWatch&) = delete;
  HostPauseWatch& operator=(const HostPauseWatch&) = delete;

  /// Watches this core at this priority of SCHED_FIFO: one above both programs, so that neither can be taken
  /// for the host. Without that right nothing is counted. To be called before memory is locked, which a new
  /// thread's stack may not survive. Returns why nothing is watched, with the fix, or "".
  std::string Start(int core, int priority);

  /// Sum of the host pauses since the start. RT: safe, any thread.
  std::int64_t paused_ns() const noexcept { return paused_ns_.load(std::memory_order_relaxed); }

 private:
  /// A pause is known to within one beat. A thousand wake-ups of 4 us per second cost the core 0.4 %. No
  /// multiple of a usual period: else a run would meet the watch at the same place in every cycle, or in
  /// none.
  static constexpr std::int64_t kBeat_ns = 970'000;
  /// Oversleeping by less is a wake-up latency, and the programs' own business.
  static constexpr std::int64_t kPause_ns = 500'000;

  void Watch() noexcept;

  std::atomic<std::int64_t> paused_ns_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reed::rt
