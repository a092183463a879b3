// How long something short takes, on a machine that others use too: many batches, the quickest and the median
// batch. One process can sit in a slow mode of the machine, so callers start several. With --count nothing is
// timed: every input is run once under the eyes of callgrind (tools/reed_tools/bench/callgrind.py), which counts
// its instructions exactly.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "reed/rt/clock.h"

/// One function under one name: no copy per caller, or callgrind would not find it.
#ifdef __clang__
#define REED_ONE_COPY [[gnu::noinline]]
#else
#define REED_ONE_COPY [[gnu::noipa]]
#endif

/// callgrind counts what happens in here, call by call; it finds the function by this name.
extern "C" REED_ONE_COPY inline void reed_bench_one(void (*call)(void* stage, int k), void* stage, int k) {
  call(stage, k);
  asm volatile("" : : : "memory");  // not a tail call: the function must be seen to end
}

namespace reed::bench {

inline constexpr int kInputs = 64;

/// The compiler must not drop a value that nobody reads.
template <typename T>
void Keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

class Stopwatch {
 public:
  Stopwatch(int argc, char** argv) : counting_(argc > 1 && std::strcmp(argv[1], "--count") == 0) {}

  /// Runs step(k) for k = 0, 1, … and prints one line: {"name": …, "best_ns": …, "median_ns": …}, or when
  /// counting {"name": …, "calls": …}. The first pass over the inputs warms up.
  template <typename Step>
  void Measure(const std::string& name, Step&& step) const {
    int k = 0;
    for (; k < kInputs; ++k) step(k);
    if (counting_) {
      const auto call = [](void* stage, int i) { (*static_cast<std::remove_reference_t<Step>*>(stage))(i); };
      for (; k < 2 * kInputs; ++k) reed_bench_one(call, &step, k);
      std::printf("{\"name\": \"%s\", \"calls\": %d}\n", name.c_str(), kInputs);
      return;
    }
    const rt::MonotonicClock clock;
    std::vector<double> ns;
    for (int batch = 0; batch < kBatches; ++batch) {
      const std::int64_t start = clock.NowNs();
      for (int i = 0; i < kInputs; ++i) step(k++);
      ns.push_back(static_cast<double>(clock.NowNs() - start) / kInputs);
    }
    std::sort(ns.begin(), ns.end());
    std::printf("{\"name\": \"%s\", \"best_ns\": %.1f, \"median_ns\": %.1f}\n", name.c_str(), ns.front(),
                ns[ns.size() / 2]);
  }

 private:
  static constexpr int kBatches = 300;
  bool counting_;
};

}  // namespace reed::bench
