// The loop's view of a cycle, whatever the number of joints. It costs one virtual call per period.
// RT: safe.
#pragma once

#include <cstdint>

#include "reed/bus/transport/transport.h"
#include "reed/core/cycle_state.h"
#include "reed/core/events.h"
#include "reed/core/safety/reason.h"
#include "reed/firmware/snapshot/snapshot.h"

namespace reed {

enum class CycleStatus : std::uint8_t { kRunning, kFinished, kBusLost };

class CycleBase {
 public:
  virtual ~CycleBase() = default;
  /// SYNC to command. Fills the snapshot, except for its number, time and loop counters.
  virtual CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const CycleState& loop,
                          telemetry::Snapshot& snapshot) noexcept = 0;
  virtual mode::Mode mode() const noexcept = 0;
  virtual protect::Reason trip() const noexcept = 0;
  virtual TripPlace trip_place() const noexcept { return {}; }
};

}  // namespace reed
