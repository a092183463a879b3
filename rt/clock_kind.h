// The two clocks a run may have. Plain data.
#pragma once

#include <cstdint>

namespace reed::rt {

/// kRealtime: paced by CLOCK_MONOTONIC. kLockstep: the controller's next cycle starts when this one is done, and the plant's time
/// is one period per SYNC.
enum class ClockKind : std::uint8_t { kRealtime, kLockstep };

}  // namespace reed::rt
