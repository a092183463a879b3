// The clock of every deadline of the bus: CLOCK_MONOTONIC in ns. The bus links nothing of the firmware, so
// this is not rt/clock.h. RT: safe.
#pragma once

#include <cstdint>
#include <ctime>

namespace reed::bus {

inline constexpr std::int64_t kNsPerSecond = 1'000'000'000;

inline std::int64_t NowNs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * kNsPerSecond + now.tv_nsec;
}

}  // namespace reed::bus
