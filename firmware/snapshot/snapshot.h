// Everything about one cycle that leaves the loop, as plain bytes: filled by the loop in a ring's slot,
// turned into messages by an ordinary thread. Meaning, unit, frame and sign of every field: the .lcm file
// named at each struct. Fields beyond dof, num_parameters, num_events and num_frames are never read.
// RT: safe.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "reed/bus/frame/frame.h"
#include "reed/config/sizes/sizes.h"
#include "reed/rt/phase_budget.h"

namespace reed::telemetry {

inline constexpr int kMaxEvents = 4;  // of one cycle
inline constexpr int kMaxFrames =
    24;  // of one cycle: SYNC, 8 states, wrench, command, and a second set after a delay

using PerJoint = std::array<double, kMaxJoints>;
using PerParameter = std::array<double, kMaxParameters>;
using Vec3 = std::array<double, 3>;

/// lcmtypes/measured_t.lcm
struct Measured {
  PerJoint position{};                         // rad
  PerJoint velocity{};                         // rad/s
  PerJoint torque{};                           // N·m
  std::array<std::int32_t, kMaxJoints> age{};  // cycles
  std::array<std::int8_t, kMaxJoints> drive_state{};
  Vec3 force{};                 // N
  Vec3 moment{};                // N·m
  std::int32_t wrench_age = 0;  // cycles
};

/// lcmtypes/control_t.lcm
struct Control {
  double t_s = 0.0;  // s
  std::int8_t mode = 0;
  std::int8_t force_source = 0;
  PerJoint theta_plan{};      // rad
  PerJoint theta_d{};         // rad
  PerJoint theta_d_dot{};     // rad/s
  PerJoint e{};               // rad
  PerJoint s{};               // rad/s
  PerJoint v{};               // rad/s
  PerJoint v_dot{};           // rad/s²
  PerJoint tau_law{};         // N·m
  PerJoint tau{};             // N·m
  PerJoint D{};               // rad/m
  Vec3 normal{};              // 1
  double f_d = 0.0;           // N
  double f = 0.0;             // N
  double e_f = 0.0;           // N
  double e_f_integral = 0.0;  // N·s
  double z = 0.0;             // m/s
  Vec3 tip_plan{};            // m
  PerJoint observer{};        // N·m
  double k_hat_e = 0.0;       // N/m
  std::int32_t limits = 0;    // bit set
};

/// lcmtypes/adaptation_t.lcm
struct Adaptation {
  PerParameter p_hat{};    // units of the arm file
  PerParameter eta_hat{};  // same
  double sigma0 = 0.0;     // N·m·s/rad
  double sigma1 = 0.0;     // N·m
};

/// lcmtypes/timing_t.lcm
struct Timing {
  std::int32_t wake_ns = 0;
  std::int32_t rx_ns = 0;
  std::int32_t compute_ns = 0;
  std::int32_t tx_ns = 0;
  std::int32_t cycle_ns = 0;
  std::int64_t missed = 0;              // since start, as all that follow
  std::int64_t missed_host_paused = 0;  // of `missed`
  std::int64_t overruns = 0;
  std::int64_t dropped = 0;
  std::int64_t rx_over = 0;
  std::int64_t compute_over = 0;
  std::int64_t tx_over = 0;
};

/// lcmtypes/bus_t.lcm, all since start
struct BusCounters {
  std::int64_t frames_rx = 0;
  std::int64_t frames_tx = 0;
  std::int64_t lost = 0;
  std::int64_t crc_errors = 0;
  std::int64_t repeated = 0;
  std::int64_t wrong_sequence = 0;
  std::int64_t wrong_length = 0;
  std::int64_t out_of_range = 0;
  std::int64_t unknown_id = 0;
  std::int64_t malformed = 0;
  std::int64_t error_frames = 0;
  std::int64_t overflowed = 0;
  std::int64_t tx_refused = 0;
  std::int64_t late = 0;
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
