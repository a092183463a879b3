// Every value of a cycle on a tape: name, place, number of entries, and whether it is an input, which a replay plays, or
// an output, which a replay has to find again. Telemetry is on the tape by itself, from the lists of lcmtypes/*.lcm.
#pragma once

#include <algorithm>
#include <string_view>

#include "reed/firmware/snapshot/snapshot.h"

namespace reed::tape {

enum class Role : std::uint8_t { kInput, kOutput };

/// Telemetry that the machine and the bus decide, not the controller.
inline constexpr std::array<std::string_view, 11> kInputs{
    "timing.rx_ns",     "timing.compute_ns", "timing.tx_ns",  "timing.cycle_ns",
    "timing.dropped",   "bus.frames_rx",     "bus.frames_tx", "bus.malformed",
    "bus.error_frames", "bus.overflowed",    "bus.tx_refused"};

consteval Role RoleOf(std::string_view name) {
  return std::find(kInputs.begin(), kInputs.end(), name) != kInputs.end() ? Role::kInput : Role::kOutput;
}

static_assert(kMaxJoints != kMaxParameters && kMaxJoints != 3, "an array's length says what it is for");

/// v(role, name, first entry, count). S: telemetry::Snapshot, const or not. dof and num_parameters are those of the
/// whole tape.
template <typename S, typename V>
void Fields(S& s, int dof, int num_parameters, V&& v) {
  const auto in = [&](const char* name, auto& value) { v(Role::kInput, name, &value, 1); };
  const auto out = [&](const char* name, auto& value) { v(Role::kOutput, name, &value, 1); };
  const auto telemetry = [&](Role role, const char* name, auto& value) {
    if constexpr (requires { value.data(); }) {
      const int room = static_cast<int>(value.size());
      v(role, name, value.data(), room == kMaxJoints ? dof : room == kMaxParameters ? num_parameters : room);
    } else {
      v(role, name, &value, 1);
    }
  };

  in("cycle", s.cycle);
  in("time_ns", s.time_ns);
  in("frames_omitted", s.frames_omitted);
  in("loop.point_ns", s.loop.point_ns);
  in("loop.point_own_ns", s.loop.point_own_ns);
  in("loop.start_own_ns", s.loop.start_own_ns);
  in("loop.end_ns", s.loop.end_ns);
  in("loop.end_own_ns", s.loop.end_own_ns);
  in("loop.stop_wanted", s.loop.stop_wanted);
  in("loop.bus_alive", s.loop.bus_alive);

  out("loop.missed_in_row", s.loop.missed_in_row);
  out("loop.broken_in_row", s.loop.broken_in_row);
  out("loop.missed_in_row_exceeded", s.loop.missed_in_row_exceeded);
  out("loop.phase_budget_exceeded", s.loop.phase_budget_exceeded);
  out("loop.gap", s.loop.gap);
  out("loop.hold", s.loop.hold);
  out("loop.degrade", s.loop.degrade);

#define REED_TAPE(group, name) telemetry(RoleOf(#group "." #name), #group "." #name, s.group.name);
#define REED_TAPE_MEASURED(Type, name, ...) REED_TAPE(measured, name)
#define REED_TAPE_CONTROL(Type, name, ...) REED_TAPE(control, name)
#define REED_TAPE_ADAPTATION(Type, name, ...) REED_TAPE(adaptation, name)
#define REED_TAPE_BUS(Type, name, ...) REED_TAPE(bus, name)
#define REED_TAPE_TIMING(Type, name, ...) REED_TAPE(timing, name)
  REED_MEASURED_T(REED_TAPE_MEASURED)
  REED_CONTROL_T(REED_TAPE_CONTROL)
  REED_ADAPTATION_T(REED_TAPE_ADAPTATION)
  REED_BUS_T(REED_TAPE_BUS)
  REED_TIMING_T(REED_TAPE_TIMING)
#undef REED_TAPE
#undef REED_TAPE_MEASURED
#undef REED_TAPE_CONTROL
#undef REED_TAPE_ADAPTATION
#undef REED_TAPE_BUS
#undef REED_TAPE_TIMING

  out("loop.status", s.loop.status);
  in("num_events", s.num_events);
  in("num_frames", s.num_frames);
}

/// As a reader of arrays names it: kind and bytes of one entry.
template <typename T>
constexpr const char* TypeName() {
  if constexpr (std::is_same_v<T, double>) return "f8";
  if constexpr (std::is_same_v<T, bool>) return "b1";
  if constexpr (std::is_same_v<T, std::int8_t>) return "i1";
  if constexpr (std::is_same_v<T, std::int32_t>) return "i4";
  if constexpr (std::is_same_v<T, std::int64_t>) return "i8";
}

}  // namespace reed::tape
