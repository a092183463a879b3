// The clock of a loop on a host that pauses: time that counts, and how much of it the host was paused. RT: safe.
#pragma once

#include <concepts>
#include <cstdint>

#include "reed/rt/clock.h"
#include "reed/rt/host_pause_watch.h"

namespace reed::rt {

template <typename T>
concept HostClock = Clock<T> && requires(const T clock) {
  { clock.paused_ns() }
  noexcept->std::same_as<std::int64_t>;
};

/// CLOCK_MONOTONIC beside a watch on the same core. Only a bench has one; real drives do not pause.
class PausingClock : public MonotonicClock {
 public:
  explicit PausingClock(const HostPauseWatch& watch) noexcept : watch_(watch) {}
  std::int64_t paused_ns() const noexcept { return watch_.paused_ns(); }

 private:
  const HostPauseWatch& watch_;
};
static_assert(HostClock<PausingClock> && !HostClock<MonotonicClock>);

/// One instant on two clocks. `own_ns` leaves the host pauses out; without any both are the same.
struct Instant {
  std::int64_t now_ns;
  std::int64_t own_ns;
};

/// A clock that knows both times of an instant by itself, as that of a replay does.
template <typename T>
concept InstantClock = Clock<T> && requires(const T clock) {
  { clock.ReadInstant() }
  noexcept->std::same_as<Instant>;
};

/// A pause that comes between the two readings is seen by a third one; then both are taken again.
template <Clock C>
Instant ReadInstant(const C& clock) noexcept {
  if constexpr (InstantClock<C>) {
    return clock.ReadInstant();
  } else if constexpr (HostClock<C>) {
    const std::int64_t paused_ns = clock.paused_ns();
    const std::int64_t now_ns = clock.NowNs();
    const std::int64_t paused_since_ns = clock.paused_ns();
    if (paused_since_ns == paused_ns) return {now_ns, now_ns - paused_ns};
    const std::int64_t later_ns = clock.NowNs();
    return {later_ns, later_ns - paused_since_ns};
  } else {
    const std::int64_t now_ns = clock.NowNs();
    return {now_ns, now_ns};
  }
}

}  // namespace reed::rt
