// Everything about one cycle that leaves the loop, as plain bytes: filled by the loop in a ring's slot,
// turned into messages by an ordinary thread. Name, meaning, unit, frame and sign of every field are declared in the
// .lcm files and nowhere else. Fields beyond dof, num_parameters, num_events and num_frames are never read.
// RT: safe.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "reed/bus/frame/frame.h"
#include "reed/config/sizes/sizes.h"
#include "reed/lcmtypes/fields/field.h"
#include "reed/lcmtypes/generated/fields.h"
#include "reed/rt/phase_budget.h"

namespace reed::telemetry {

inline constexpr int kMaxEvents = 4;  // of one cycle
inline constexpr int kMaxFrames =
    24;  // of one cycle: SYNC, 8 states, wrench, command, and a second set after a delay

/// Numbers, units and frames: the .lcm files of the same names. RT: plain data.
struct Measured {
  REED_MEASURED_T(REED_MEMBER)
};
struct Control {
  REED_CONTROL_T(REED_MEMBER)
};
struct Adaptation {
  REED_ADAPTATION_T(REED_MEMBER)
};
struct Timing {
  REED_TIMING_T(REED_MEMBER)
};
struct BusCounters {  // all since start
  REED_BUS_T(REED_MEMBER)
};

/// lcmtypes/event_t.lcm; the text is looked up by code when the event leaves the program.
struct Event {
  std::int8_t mode = 0;
  std::int8_t force_source = 0;
  std::int32_t code = 0;
  std::int32_t joint = -1;  // 0-based, -1: not about one joint
  double value = 0.0;
  bool about_time = false;  // its text ends with the snapshot's phase history
};

enum class Direction : std::uint8_t { kReceived, kSent };

/// One line of the CAN log.
struct RecordedFrame {
  std::int32_t offset_ns = 0;  // from the snapshot's time_ns; not used in lockstep
  Direction direction = Direction::kReceived;
  bus::Frame frame;  // only the bytes that it has: behind frame.size lies what an older cycle left
};

struct Snapshot {
  std::int64_t cycle = 0;
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC at the cycle's first instruction; not used in lockstep
  std::int32_t dof = 0;
  std::int32_t num_parameters = 0;
  std::int32_t num_events = 0;
  std::int32_t num_frames = 0;
  std::int32_t frames_omitted = 0;  // frames of this cycle that found no room in `frames`
  Measured measured;
  Control control;
  Adaptation adaptation;
  Timing timing;
  BusCounters bus;
  rt::PhaseHistory phase_history{};  // ns, only read when an event is about time
  std::array<Event, kMaxEvents> events{};
  std::array<RecordedFrame, kMaxFrames> frames{};

  /// Empties the lists of a slot that still holds an old cycle. Everything else is overwritten every cycle.
  void ClearLists() noexcept { num_events = num_frames = frames_omitted = 0; }

  /// Further events of the same cycle are left out: the first one is the cause, the rest are its
  /// consequences.
  void AddEvent(const Event& event) noexcept {
    if (num_events < kMaxEvents) events[static_cast<std::size_t>(num_events++)] = event;
  }

  /// Most frames are short, and every line of cache that is not written is time won.
  void AddFrame(const bus::Frame& frame, Direction direction, std::int32_t offset_ns) noexcept {
    if (num_frames >= kMaxFrames) {
      ++frames_omitted;
      return;
    }
    constexpr std::size_t kShort = 16;
    RecordedFrame& to = frames[static_cast<std::size_t>(num_frames++)];
    to.offset_ns = offset_ns;
    to.direction = direction;
    to.frame.id = frame.id;
    to.frame.size = frame.size;
    std::memcpy(to.frame.data.data(), frame.data.data(), kShort);
    if (frame.size > kShort)
      std::memcpy(to.frame.data.data() + kShort, frame.data.data() + kShort, frame.data.size() - kShort);
  }
};
static_assert(std::is_trivially_copyable_v<Snapshot>);
static_assert(std::is_standard_layout_v<Snapshot>);
static_assert(sizeof(Snapshot) <= 4096, "a second of 1 kHz snapshots fits 4 MiB");

}  // namespace reed::telemetry
