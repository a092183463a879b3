// The loop's view of a cycle, whatever the number of joints. One virtual call per period is the whole price.
// RT: safe.
#pragma once

#include <cstdint>
#include <memory>

#include "reed/bus/transport/transport.h"
#include "reed/config/controller/controller_config.h"
#include "reed/core/safety/mode_table.h"
#include "reed/core/safety/reason.h"
#include "reed/firmware/snapshot/snapshot.h"

namespace reed {

enum class CycleStatus : std::uint8_t { kRunning, kFinished, kBusLost };

/// What the loop knows and a cycle does not.
struct LoopState {
  bool stop_wanted = false;
  bool missed_in_row_exceeded = false;
  int missed_in_row = 0;
  bool phase_budget_exceeded = false;  // in too many cycles in a row
  int broken_in_row = 0;
  bool gap = false;      // since the last SYNC more than a period has passed
  bool hold = false;     // after an overrun or a broken budget: repeat the last command
  bool degrade = false;  // leave out what can wait
};

/// Of a trip: the joint, 0-based, -1 for none in particular, and the value in the unit of its text.
struct TripPlace {
  int joint = -1;
  double value = 0.0;
};

class CycleBase {
 public:
  virtual ~CycleBase() = default;
  /// SYNC to command. Fills the snapshot, except for its number, time and loop counters.
  virtual CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const LoopState& loop,
                          telemetry::Snapshot& snapshot) noexcept = 0;
  virtual mode::Mode mode() const noexcept = 0;
  virtual protect::Reason trip() const noexcept = 0;
  virtual TripPlace trip_place() const noexcept { return {}; }
};

/// The cycle for this arm's number of joints (2 … 8) and parameters. Set-up only; throws std::runtime_error
/// with one line.
std::unique_ptr<CycleBase> MakeCycle(const ControllerConfig& scenario, bus::Transport& transport,
                                     bool start_wanted);

}  // namespace reed
