// What the plant reports, as plain data that crosses from the simulation to the publishing thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "reed/config/description/arm_structure.h"
#include "reed/lcmtypes/fields/field.h"
#include "reed/lcmtypes/generated/fields.h"

namespace reed::plant {

/// Since start, in which the arm's clock was held.
struct HostPauses {
  std::int64_t count = 0;
  double total_s = 0.0;
};

/// Numbers, units, frames and signs: lcmtypes/plant_t.lcm.
struct PlantRecord {
  std::int64_t utime = 0;
  std::int64_t cycle = 0;
  std::int32_t dof = 0;
  REED_PLANT_T(REED_MEMBER)
};

/// Mirrors lcmtypes/shape_t.lcm. Its size keeps the message below one datagram.
inline constexpr std::size_t kMaxShapePoints = 48;
struct ShapeRecord {
  std::int64_t utime = 0;
  std::int64_t cycle = 0;
  std::size_t num = 0;
  std::array<std::array<float, kMaxShapePoints>, 3> bent{}, rigid{};  // m, [axis][point]
};

/// Numbers, units: lcmtypes/wire_t.lcm.
struct WireRecord {
  std::int64_t utime = 0;
  std::int64_t cycle = 0;
  double answers_us = 0.0, command_us = 0.0;
  double foreign_s = 0.0;
  std::int64_t dropped = 0;
  double computed_answers_us = 0.0, computed_command_us = 0.0;
};

/// Numbers of event_t.code on REED_PLANT_EVENT. Fixed for ever: logs outlive versions.
enum class PlantEvent : std::int32_t {
  kControllerPresent = 200,
  kControllerRestarted = 201,
  kDriveState = 202,  // value: the new bus::DriveState
  kBrakesReleased = 203,
  kBrakesClosed = 204,
  kEnableRefused = 205,  // value: fastest motor, rad/s
  kContactMade = 206,    // value: normal force, N
  kContactLost = 207,
  kDiverged = 208,  // value: plant time, s
  kTooSlow = 209,   // value: plant time given up, s
  kWrenchLost = 210,
  kWrenchBack = 211,
  kHostPause = 212,    // value: for how long, s
  kAnotherArm = 213,   // value: plant time, s
  kFaultBegins = 214,  // value: its number in the scenario, from 0
  kFaultEnds = 215,
};

/// Mirrors lcmtypes/event_t.lcm.
struct EventRecord {
  std::int64_t utime = 0;
  std::int64_t cycle = 0;
  std::int8_t mode = 0;  // 0 off, 1 ready, 2 active, 3 fault: braked and fault are both 3
  PlantEvent code = PlantEvent::kControllerPresent;
  double value = 0.0;
  std::array<char, 240> text{};  // zero-terminated
};

using Record = std::variant<PlantRecord, EventRecord, ShapeRecord, WireRecord>;
static_assert(std::is_trivially_copyable_v<Record>);

/// Where records go. RT: as safe as the implementation.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  virtual void Put(const Record& record) noexcept = 0;
};

}  // namespace reed::plant
