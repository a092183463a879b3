// What the plant reports, as plain data that crosses from the simulation to the publishing thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "reed/config/description/arm_structure.h"

namespace reed::plant {

/// Mirrors lcmtypes/plant_t.lcm: units, frames and signs are there.
struct PlantRecord {
  std::int64_t utime = 0;
  std::int64_t cycle = 0;
  double t_s = 0.0;
  std::int32_t dof = 0;
  std::array<double, kMaxJoints> motor_angle{}, motor_speed{}, joint_angle{}, torque{};
  bool braked = true;
  std::array<double, 3> tip{}, tip_velocity{}, contact_force{};
  double normal_force = 0.0, gap = 0.0;
  double kinetic_J = 0.0, elastic_J = 0.0, potential_J = 0.0;
  std::int64_t host_pauses = 0;
  double host_pause_s = 0.0;
};

/// Mirrors lcmtypes/shape_t.lcm. Its size keeps the message below one datagram.
inline constexpr std::size_t kMaxShapePoints = 48;
struct ShapeRecord {
  std::int64_t utime = 0;
  std::int64_t cycle = 0;
  std::size_t num = 0;
  std::array<std::array<float, kMaxShapePoints>, 3> bent{}, rigid{};  // m, [axis][point]
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
  kHostPause = 212,   // value: for how long, s
  kAnotherArm = 213,  // value: plant time, s
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

using Record = std::variant<PlantRecord, EventRecord, ShapeRecord>;
static_assert(std::is_trivially_copyable_v<Record>);

/// Where records go. RT: as safe as the implementation.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void Put(const Record& record) noexcept = 0;
};

}  // namespace reed::plant
