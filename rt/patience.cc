#include "reed/rt/patience.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "reed/rt/clock.h"
#include "reed/rt/program.h"

namespace reed::rt {

bool AwaitDone(const std::atomic<bool>& done, const std::atomic<std::int64_t>& progress,
               std::int64_t patience_ns) noexcept {
  constexpr std::int64_t kLook_ns = 1'000'000;
  const MonotonicClock clock;
  std::int64_t seen = progress.load(std::memory_order_relaxed);
  std::int64_t moved_ns = clock.NowNs();
  while (!done.load(std::memory_order_acquire)) {
    const std::int64_t now_ns = clock.NowNs();
    if (const std::int64_t now = progress.load(std::memory_order_relaxed); now != seen) {
      seen = now;
      moved_ns = now_ns;
    }
    if (now_ns - moved_ns > patience_ns) return false;
    clock.SleepUntil(now_ns + kLook_ns);
  }
  return true;
}

std::string TakesNothing(const std::string& file) {
  return file + ": takes nothing any more and was given up; what it has not taken is lost";
}

void AbandonProcess(const std::string& line) noexcept {
  std::fprintf(stderr, "%s: %s\n", program_invocation_short_name, line.c_str());
  std::fflush(stderr);
  std::_Exit(kDied);
}

}  // namespace reed::rt
