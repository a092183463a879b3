// Typed messages on one side, protected CAN FD frames on the other. Layout: bus/reed.dbc, through the
// generated codec. Every frame carries E2E profile 5 (e2e_profile5.h). SI units. RT: safe (no allocation, no
// throw).
//
// Numbers that do not fit. Finite values and infinities outside the DBC's range are sent as the nearest
// bound. A NaN torque command is sent as 0, because a drive that gets no torque is safer than one that gets
// none of the cycle's commands; a NaN measurement is sent as NaN and makes the receiver refuse the frame,
// because a receiver would use an invented measurement. Both are counted. The receiver refuses a whole frame if
// one signal is NaN or out of range.
#pragma once

#include <array>
#include <cstdint>

#include "reed/bus/codec/e2e_profile5.h"
#include "reed/bus/frame/frame.h"
#include "reed/config/sizes/sizes.h"
#include "reed_layout.h"

namespace reed::bus {

/// What the controller requests of the drives. Drives change state only on a change of request, in this order;
/// a stream of torques alone never starts an arm.
enum class DriveRequest : std::uint8_t { kOff = 0, kReady = 1, kEnable = 2 };
enum class DriveState : std::uint8_t { kOff = 0, kReady = 1, kEnabled = 2, kBraked = 3, kFault = 4 };

struct SyncMessage {
  std::uint32_t cycle = 0;
  std::uint8_t layout = layout::kLayoutId;  // of the DBC that the sender was built with
};

struct JointStateMessage {
  double position_rad = 0.0;    // motor side
  double velocity_radps = 0.0;  // motor side, filtered
  double torque_Nm = 0.0;       // torque the drive applies
  DriveState state = DriveState::kOff;
  std::uint8_t cycle_low4 = 0;  // SYNC cycle modulo 16
};

struct WrenchMessage {
  std::uint32_t cycle = 0;
  std::array<double, 3> force_N{};  // on the tool behind the sensor, sensor's axes
  std::array<double, 3> moment_Nm{};
  bool saturated = false;
};

struct CommandMessage {
  std::uint32_t cycle = 0;
  DriveRequest request = DriveRequest::kOff;
  std::array<double, kMaxJoints> torque_Nm{};
};

/// Signals that had to be changed, or could not be, to be sent.
struct EncodeCounters {
  std::uint64_t clamped = 0;
  std::uint64_t not_a_number = 0;
};

/// Builds protected frames; keeps one E2E counter per frame identifier.
class FrameEncoder {
 public:
  Frame Sync(const SyncMessage& message) noexcept;
  Frame JointState(int joint, const JointStateMessage& message) noexcept;  // joint 0-based
  Frame Wrench(const WrenchMessage& message) noexcept;
  Frame Command(const CommandMessage& message) noexcept;
  const EncodeCounters& counters() const noexcept { return counters_; }

 private:
  E2eSender sync_, wrench_, command_;
  std::array<E2eSender, kMaxJoints> joint_;
  EncodeCounters counters_;
};

enum class MessageKind : std::uint8_t { kUnknown, kSync, kJointState, kWrench, kCommand };

/// Why a frame's content may not be used.
enum class Reject : std::uint8_t {
  kNone,       // content valid
  kUnknownId,  // identifier not in the DBC
  kLength,     // size differs from the DBC's
  kCrc,        // E2E: CRC wrong
  kRepeated,   // E2E: same counter again
  kSequence,   // E2E: counter jumped further than kMaxDeltaCounter
  kRange,      // a signal is NaN or outside the DBC's range
};
inline constexpr int kNumRejects = 7;

struct Decoded {
  MessageKind kind = MessageKind::kUnknown;
  Reject reject = Reject::kNone;
  E2eState e2e = E2eState::kNone;
  std::uint8_t lost = 0;  // frames skipped since the last good one (E2E OkSomeLost)
  int joint = -1;         // for kJointState
  SyncMessage sync;
  JointStateMessage joint_state;
  WrenchMessage wrench;
  CommandMessage command;
};

/// Whether it is genuine, usable or not. A damaged frame proves nothing, not even its sender.
constexpr bool IsGenuine(const Decoded& decoded) noexcept {
  return decoded.reject != Reject::kUnknownId && decoded.reject != Reject::kLength &&
         decoded.reject != Reject::kCrc;
}

/// Receiver counters, one cell per reason. frames lost are those the E2E counters prove were sent but not
/// seen.
struct DecodeCounters {
  std::array<std::uint64_t, kNumRejects> rejected{};
  std::uint64_t accepted = 0;
  std::uint64_t lost = 0;
};

/// Checks and decodes frames; keeps one E2E receiver per frame identifier.
class Decoder {
 public:
  /// The message of `kind` is valid if `reject` is kNone; the others keep their defaults.
  Decoded Decode(const Frame& frame) noexcept;
  const DecodeCounters& counters() const noexcept { return counters_; }

 private:
  E2eReceiver sync_, wrench_, command_;
  std::array<E2eReceiver, kMaxJoints> joint_;
  DecodeCounters counters_;
};

}  // namespace reed::bus
