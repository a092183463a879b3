// Everything about one cycle that leaves the loop, as plain bytes: filled by the loop in a ring's slot,
// turned into messages by an ordinary thread. Name, meaning, unit, frame and sign of every field are declared in the
// .lcm files and nowhere else. Fields beyond dof, num_parameters, num_law_values, num_events and frame_bytes are never read.
// RT: safe.
#pragma once

#include <array>
#include <cstddef>
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
/// Room for the frames of one cycle: 100 states, as much as a cycle takes from a bus that was held up.
inline constexpr std::size_t kFrameRoom = 2800;  // bytes

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
  std::int32_t offset_ns = 0;  // from the snapshot's time_ns
  Direction direction = Direction::kReceived;
  bus::Frame frame;
};

/// What the loop knew beside the frames: with them, all that enters a cycle.
struct LoopRecord {
  std::int64_t point_ns = 0, point_own_ns = 0;  // grid point on the clock, and without host pauses
  std::int64_t start_own_ns = 0;                // the cycle's first instruction, beside time_ns
  std::int64_t end_ns = 0, end_own_ns = 0;      // read behind the cycle
  std::int32_t missed_in_row = 0;
  std::int32_t broken_in_row = 0;
  bool stop_wanted = false;
  bool missed_in_row_exceeded = false;
  bool phase_budget_exceeded = false;
  bool gap = false;
  bool hold = false;
  bool degrade = false;
  bool bus_alive = true;
  std::int8_t status = 0;  // CycleStatus
};

struct Snapshot {
  std::int64_t cycle = 0;
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC at the cycle's first instruction; not used in lockstep
  std::int32_t dof = 0;
  std::int32_t num_parameters = 0;
  std::int32_t num_law_values = 0;
  std::int32_t num_events = 0;
  std::int32_t num_frames = 0;
  std::int32_t frames_omitted = 0;  // frames of this cycle that found no room in `frames`
  Measured measured;
  Control control;
  Adaptation adaptation;
  std::array<double, kMaxLawValues> law_values{};  // of a law from outside: lcmtypes/law_t.lcm
  Timing timing;
  BusCounters bus;
  rt::PhaseHistory phase_history{};  // ns, only read when an event is about time
  LoopRecord loop;
  std::array<Event, kMaxEvents> events{};
  std::size_t frame_bytes = 0;
  std::array<std::byte, kFrameRoom> frames{};  // one behind the other; ForEachFrame reads them

  /// Empties the lists of a slot that still holds an old cycle. Everything else is overwritten every cycle.
  void ClearLists() noexcept {
    num_events = num_frames = frames_omitted = 0;
    frame_bytes = 0;
  }

  /// Further events of the same cycle are left out: the first one is the cause, the rest are its
  /// consequences.
  void AddEvent(const Event& event) noexcept {
    if (num_events < kMaxEvents) events[static_cast<std::size_t>(num_events++)] = event;
  }

  /// Most frames are short, and every line of cache that is not written is time won.
  void AddFrame(const bus::Frame& frame, Direction direction, std::int32_t offset_ns) noexcept {
    if (frame_bytes + sizeof(FrameHead) + frame.data.size() > kFrameRoom) {
      ++frames_omitted;
      return;
    }
    constexpr std::size_t kShort = 16;
    const FrameHead head{offset_ns, frame.id, direction, frame.size, frame.extended};
    std::byte* const to = frames.data() + frame_bytes;
    std::memcpy(to, &head, sizeof head);
    std::memcpy(to + sizeof head, frame.data.data(), kShort);
    if (frame.size > kShort)
      std::memcpy(to + sizeof head + kShort, frame.data.data() + kShort, frame.data.size() - kShort);
    frame_bytes += sizeof head + frame.size;
    ++num_frames;
  }

  /// In the order in which they passed. For readers: it copies.
  template <typename Use>
  void ForEachFrame(Use&& use) const {
    const std::byte* at = frames.data();
    for (std::int32_t i = 0; i < num_frames; ++i) {
      FrameHead head;
      std::memcpy(&head, at, sizeof head);
      RecordedFrame recorded{head.offset_ns, head.direction, {head.id, head.size, {}, head.extended}};
      std::memcpy(recorded.frame.data.data(), at + sizeof head, head.size);
      use(recorded);
      at += sizeof head + head.size;
    }
  }

  /// For a replay, whose own times of arrival say nothing: those of then, as far as the frames are those of then.
  void TakeFrameTimes(const Snapshot& then) noexcept {
    std::size_t at = 0;
    for (std::int32_t i = 0; i < num_frames && i < then.num_frames; ++i) {
      FrameHead head, head_then;
      std::memcpy(&head, frames.data() + at, sizeof head);
      std::memcpy(&head_then, then.frames.data() + at, sizeof head_then);
      if (head.size != head_then.size) return;
      std::memcpy(frames.data() + at, &head_then.offset_ns, sizeof head_then.offset_ns);
      at += sizeof head + head.size;
    }
  }

 private:
  struct FrameHead {
    std::int32_t offset_ns;
    std::uint32_t id;
    Direction direction;
    std::uint8_t size;
    bool extended;
  };
};
static_assert(std::is_trivially_copyable_v<Snapshot>);
static_assert(sizeof(Snapshot) <= 5120, "a second of 1 kHz snapshots fits 5 MiB");

}  // namespace reed::telemetry
