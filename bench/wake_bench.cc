// Wake-up latency of the loop's own clock: 1 kHz grid, SCHED_FIFO, pinned. `reed_bench_wake SECONDS CORE`,
// the counterpart of cyclictest -p 80 -i 1000.
#include <cstdio>
#include <cstdlib>

#include "reed/firmware/record/histogram.h"
#include "reed/rt/clock.h"
#include "reed/rt/grid.h"
#include "reed/rt/realtime_scope.h"

int main(int argc, char** argv) {
  const auto number = [](const char* text) { return static_cast<int>(std::strtol(text, nullptr, 10)); };
  const int seconds = argc > 1 ? number(argv[1]) : 10, core = argc > 2 ? number(argv[2]) : -1;
  static reed::telemetry::Histogram histogram;
  const reed::rt::RealtimeScope scope({80, core, true});
  for (const std::string& line : scope.report().Complaints()) std::fprintf(stderr, "%s\n", line.c_str());
  const reed::rt::MonotonicClock clock;
  constexpr std::int64_t kPeriod = 1'000'000, kLate = 1'000'000;
  std::int64_t deadline = clock.NowNs() + kPeriod;
  int late = 0;
  for (int k = 0; k < 1000 * seconds; ++k) {
    clock.SleepUntil(deadline);
    const std::int64_t now = clock.NowNs();
    histogram.Add(static_cast<std::int32_t>(now - deadline));
    late += now - deadline > kLate ? 1 : 0;
    deadline = reed::rt::NextTick(deadline, kPeriod, now).deadline_ns;
  }
  std::printf("{\"p50_us\": %.1f, \"p99_us\": %.1f, \"late\": %d}\n", histogram.Quantile(0.5) * 1e-3,
              histogram.Quantile(0.99) * 1e-3, late);
}
