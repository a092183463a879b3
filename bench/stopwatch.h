// Nanoseconds per call of something short, on a machine that others use too: many batches, the quickest and
// the median batch. One process can sit in a slow mode of the machine, so callers start several.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "firmware/rt/clock.h"

namespace reed::bench {

struct Spread {
  double best_ns = 0.0, median_ns = 0.0;
};

/// Calls step(k) for k = 0, 1, … in batches of `per_batch`.
template <typename Step>
Spread Measure(Step&& step, int batches = 400, int per_batch = 250) {
  const rt::MonotonicClock clock;
  std::vector<double> ns;
  int k = 0;
  for (int batch = 0; batch < batches; ++batch) {
    const std::int64_t start = clock.NowNs();
    for (int i = 0; i < per_batch; ++i) step(k++);
    ns.push_back(static_cast<double>(clock.NowNs() - start) / per_batch);
  }
  std::sort(ns.begin(), ns.end());
  return {ns.front(), ns[ns.size() / 2]};
}

/// One line that tools/reed bench reads: {"name": …, "best_ns": …, "median_ns": …}
inline void Print(const char* name, const Spread& spread) {
  std::printf("{\"name\": \"%s\", \"best_ns\": %.1f, \"median_ns\": %.1f}\n", name, spread.best_ns,
              spread.median_ns);
}

/// The compiler must not drop a value that nobody reads.
template <typename T>
void Keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace reed::bench
