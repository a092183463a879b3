// CLOCK_MONOTONIC in ns: the clock of every deadline. RT: safe.
#pragma once

#include <cstdint>
#include <ctime>

namespace reed::rt {

inline constexpr std::int64_t kNsPerSecond = 1'000'000'000;

inline std::int64_t NowNs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * kNsPerSecond + now.tv_nsec;
}

}  // namespace reed::rt
