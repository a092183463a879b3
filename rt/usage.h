// What the kernel counted for the calling thread: take one before and one after, and subtract. RT: safe (one
// system call).
#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace reed::rt {

struct Usage {
  std::int64_t minor_faults = 0;          // pages that had to be mapped
  std::int64_t major_faults = 0;          // pages that had to be read from disk
  std::int64_t voluntary_switches = 0;    // the thread waited
  std::int64_t involuntary_switches = 0;  // the thread was taken off its core

  std::int64_t page_faults() const noexcept { return minor_faults + major_faults; }
};

inline Usage ThreadUsage() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return {usage.ru_minflt, usage.ru_majflt, usage.ru_nvcsw, usage.ru_nivcsw};
}

constexpr Usage operator-(const Usage& after, const Usage& before) noexcept {
  return {after.minor_faults - before.minor_faults, after.major_faults - before.major_faults,
          after.voluntary_switches - before.voluntary_switches,
          after.involuntary_switches - before.involuntary_switches};
}

constexpr Usage& operator+=(Usage& sum, const Usage& more) noexcept {
  sum.minor_faults += more.minor_faults;
  sum.major_faults += more.major_faults;
  sum.voluntary_switches += more.voluntary_switches;
  sum.involuntary_switches += more.involuntary_switches;
  return sum;
}

}  // namespace reed::rt
