#include "reed/rt/host_pause_watch.h"

#include <ctime>
#include <future>
#include <utility>

#include "reed/rt/errno_text.h"
#include "reed/rt/monotonic.h"
#include "reed/rt/rights.h"

namespace reed::rt {
namespace {

std::int64_t TimerResolution_ns() {
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  return resolution.tv_sec * kNsPerSecond + resolution.tv_nsec;
}

/// Core and priority for this thread; why they are refused, or "".
std::string Ask(int core, int priority) {
  if (PinTo(core) && RaiseTo(priority)) return "";
  return "host pauses are not measured: SCHED_FIFO " + std::to_string(priority) + " on core " +
         std::to_string(core) + " not granted to the thread that would measure them (" + ErrnoText() +
         "); fix: run as root, or rtprio 99 in /etc/security/limits.conf";
}

}  // namespace

std::string HostPauseWatch::Start(int core, int priority) {
  if (TimerResolution_ns() > kPause_ns) {
    return "host pauses are not measured: the timers are too coarse (" +
           std::to_string(TimerResolution_ns() / 1000) + " us); fix: a kernel with CONFIG_HIGH_RES_TIMERS";
  }
  std::promise<std::string> asked;
  std::future<std::string> answer = asked.get_future();
  thread_ = std::thread([this, core, priority, asked = std::move(asked)]() mutable {
    const std::string refused = Ask(core, priority);
    asked.set_value(refused);
    if (refused.empty()) Watch();
  });
  return answer.get();
}

HostPauseWatch::~HostPauseWatch() {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

void HostPauseWatch::Watch() noexcept {
  std::int64_t due_ns = NowNs();
  while (!stop_.load(std::memory_order_relaxed)) {
    due_ns += kBeat_ns;
    const timespec due{due_ns / kNsPerSecond, due_ns % kNsPerSecond};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    const std::int64_t late_ns = NowNs() - due_ns;
    if (late_ns < kPause_ns) continue;
    paused_ns_.store(paused_ns_.load(std::memory_order_relaxed) + late_ns, std::memory_order_relaxed);
    due_ns += late_ns;
  }
}

}  // namespace reed::rt
