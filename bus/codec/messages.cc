#include "reed/bus/codec/messages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reed.h"

namespace reed::bus {
namespace {

static_assert(layout::kJointState.size() == kMaxJoints && layout::kCommandTorque.size() == kMaxJoints);
static_assert(
    [] {
      for (std::size_t j = 0; j < kMaxJoints; ++j) {
        if (layout::kJointState[j].id != layout::kJointState[0].id + j) return false;
      }
      return true;
    }(),
    "a joint's frame is found by its distance from the first one");

/// The nearest number that the signal can carry; NaN stays NaN.
double Fit(double value, Bounds bounds, EncodeCounters& counters) noexcept {
  if (std::isnan(value)) {
    ++counters.not_a_number;
    return value;
  }
  const double fitted = std::clamp(value, bounds.min, bounds.max);
  if (fitted != value) ++counters.clamped;
  return fitted;
}

double NanToZero(double value) noexcept { return std::isnan(value) ? 0.0 : value; }

/// One frame: signals through the generated `pack`, then the protection over them.
template <typename Signals>
Frame Build(const Signals& signals, int (*pack)(std::uint8_t*, const Signals*, std::size_t),
            const FrameLayout& layout, E2eSender& e2e) noexcept {
  Frame frame;
  frame.id = layout.id;
  frame.size = layout.size;
  pack(frame.data.data(), &signals, layout.size);
  e2e.Protect(std::span(frame.data).first(layout.size), layout.data_id);
  return frame;
}

bool Unpack(const Frame& frame, SyncMessage& out) noexcept {
  reed_sync_t in{};
  reed_sync_unpack(&in, frame.data.data(), frame.size);
  out.cycle = in.cycle;
  out.layout = in.layout;
  return true;
}

bool Unpack(const Frame& frame, JointStateMessage& out) noexcept {
  reed_joint_state_1_t in{};
  reed_joint_state_1_unpack(&in, frame.data.data(), frame.size);
  if (!reed_joint_state_1_drive_state_is_in_range(in.drive_state) ||
      !reed_joint_state_1_position_is_in_range(in.position) ||
      !reed_joint_state_1_velocity_is_in_range(in.velocity) ||
      !reed_joint_state_1_torque_is_in_range(in.torque)) {
    return false;
  }
  out.position_rad = reed_joint_state_1_position_decode(in.position);
  out.velocity_radps = reed_joint_state_1_velocity_decode(in.velocity);
  out.torque_Nm = reed_joint_state_1_torque_decode(in.torque);
  out.state = static_cast<DriveState>(in.drive_state);
  out.cycle_low4 = in.cycle_low4;
  return true;
}

bool Unpack(const Frame& frame, WrenchMessage& out) noexcept {
  reed_wrench_t in{};
  reed_wrench_unpack(&in, frame.data.data(), frame.size);
  if (!reed_wrench_force_x_is_in_range(in.force_x) || !reed_wrench_force_y_is_in_range(in.force_y) ||
      !reed_wrench_force_z_is_in_range(in.force_z) || !reed_wrench_moment_x_is_in_range(in.moment_x) ||
      !reed_wrench_moment_y_is_in_range(in.moment_y) || !reed_wrench_moment_z_is_in_range(in.moment_z)) {
    return false;
  }
  out.cycle = in.cycle;
  out.force_N = {reed_wrench_force_x_decode(in.force_x), reed_wrench_force_y_decode(in.force_y),
                 reed_wrench_force_z_decode(in.force_z)};
  out.moment_Nm = {reed_wrench_moment_x_decode(in.moment_x), reed_wrench_moment_y_decode(in.moment_y),
                   reed_wrench_moment_z_decode(in.moment_z)};
  out.saturated = in.saturated != 0;
  return true;
}

bool Unpack(const Frame& frame, CommandMessage& out) noexcept {
  reed_command_t in{};
  reed_command_unpack(&in, frame.data.data(), frame.size);
  if (!reed_command_request_is_in_range(in.request) || !reed_command_torque_1_is_in_range(in.torque_1) ||
      !reed_command_torque_2_is_in_range(in.torque_2) || !reed_command_torque_3_is_in_range(in.torque_3) ||
      !reed_command_torque_4_is_in_range(in.torque_4) || !reed_command_torque_5_is_in_range(in.torque_5) ||
      !reed_command_torque_6_is_in_range(in.torque_6) || !reed_command_torque_7_is_in_range(in.torque_7) ||
      !reed_command_torque_8_is_in_range(in.torque_8)) {
    return false;
  }
  out.cycle = in.cycle;
  out.request = static_cast<DriveRequest>(in.request);
  out.torque_Nm = {reed_command_torque_1_decode(in.torque_1), reed_command_torque_2_decode(in.torque_2),
                   reed_command_torque_3_decode(in.torque_3), reed_command_torque_4_decode(in.torque_4),
                   reed_command_torque_5_decode(in.torque_5), reed_command_torque_6_decode(in.torque_6),
                   reed_command_torque_7_decode(in.torque_7), reed_command_torque_8_decode(in.torque_8)};
  return true;
}

Reject RejectFor(E2eState state) noexcept {
  switch (state) {
    case E2eState::kOk:
    case E2eState::kOkSomeLost:
      return Reject::kNone;
    case E2eState::kRepeated:
      return Reject::kRepeated;
    case E2eState::kWrongSequence:
      return Reject::kSequence;
    case E2eState::kNone:
    case E2eState::kCrcError:
      break;
  }
  return Reject::kCrc;
}

/// Length, protection, range: in this order, since each one makes sense only after the one before.
template <typename Message>
void Read(const Frame& frame, const FrameLayout& layout, E2eReceiver& receiver, Decoded& out,
          Message& message) noexcept {
  if (frame.size != layout.size) {
    out.reject = Reject::kLength;
    return;
  }
  const E2eCheck check = receiver.Check(std::span(frame.data).first(layout.size), layout.data_id);
  out.e2e = check.state;
  out.lost = check.lost;
  out.reject = RejectFor(check.state);
  if (out.reject == Reject::kNone && !Unpack(frame, message)) out.reject = Reject::kRange;
}

}  // namespace

Frame FrameEncoder::Sync(const SyncMessage& message) noexcept {
  reed_sync_t out{};
  out.layout = message.layout;
  out.cycle = message.cycle;
  return Build(out, reed_sync_pack, layout::kSync, sync_);
}

Frame FrameEncoder::JointState(int joint, const JointStateMessage& message) noexcept {
  const auto j = static_cast<std::size_t>(joint);
  reed_joint_state_1_t out{};
  out.drive_state = static_cast<std::uint8_t>(message.state);
  out.cycle_low4 = message.cycle_low4 & 0xFU;
  out.position =
      reed_joint_state_1_position_encode(Fit(message.position_rad, layout::kJointStatePosition, counters_));
  out.velocity =
      reed_joint_state_1_velocity_encode(Fit(message.velocity_radps, layout::kJointStateVelocity, counters_));
  out.torque = reed_joint_state_1_torque_encode(Fit(message.torque_Nm, layout::kJointStateTorque, counters_));
  return Build(out, reed_joint_state_1_pack, layout::kJointState[j], joint_[j]);
}

Frame FrameEncoder::Wrench(const WrenchMessage& message) noexcept {
  const auto& f = message.force_N;
  const auto& m = message.moment_Nm;
  reed_wrench_t out{};
  out.saturated = message.saturated ? 1 : 0;
  out.force_x = reed_wrench_force_x_encode(Fit(f[0], layout::kWrenchForceX, counters_));
  out.force_y = reed_wrench_force_y_encode(Fit(f[1], layout::kWrenchForceY, counters_));
  out.force_z = reed_wrench_force_z_encode(Fit(f[2], layout::kWrenchForceZ, counters_));
  out.moment_x = reed_wrench_moment_x_encode(Fit(m[0], layout::kWrenchMomentX, counters_));
  out.moment_y = reed_wrench_moment_y_encode(Fit(m[1], layout::kWrenchMomentY, counters_));
  out.moment_z = reed_wrench_moment_z_encode(Fit(m[2], layout::kWrenchMomentZ, counters_));
  out.cycle = message.cycle;
  return Build(out, reed_wrench_pack, layout::kWrench, wrench_);
}

Frame FrameEncoder::Command(const CommandMessage& message) noexcept {
  std::array<double, kMaxJoints> tau{};
  for (std::size_t j = 0; j < kMaxJoints; ++j) {
    tau[j] = NanToZero(Fit(message.torque_Nm[j], layout::kCommandTorque[j], counters_));
  }
  reed_command_t out{};
  out.request = static_cast<std::uint8_t>(message.request);
  out.cycle = message.cycle;
  out.torque_1 = reed_command_torque_1_encode(tau[0]);
  out.torque_2 = reed_command_torque_2_encode(tau[1]);
  out.torque_3 = reed_command_torque_3_encode(tau[2]);
  out.torque_4 = reed_command_torque_4_encode(tau[3]);
  out.torque_5 = reed_command_torque_5_encode(tau[4]);
  out.torque_6 = reed_command_torque_6_encode(tau[5]);
  out.torque_7 = reed_command_torque_7_encode(tau[6]);
  out.torque_8 = reed_command_torque_8_encode(tau[7]);
  return Build(out, reed_command_pack, layout::kCommand, command_);
}

Decoded Decoder::Decode(const Frame& frame) noexcept {
  Decoded out;
  const std::uint32_t joint = frame.id - layout::kJointState[0].id;
  if (frame.extended) {  // of another protocol
    out.reject = Reject::kUnknownId;
  } else if (frame.id == layout::kSync.id) {
    out.kind = MessageKind::kSync;
    Read(frame, layout::kSync, sync_, out, out.sync);
  } else if (joint < kMaxJoints) {
    out.kind = MessageKind::kJointState;
    out.joint = static_cast<int>(joint);
    Read(frame, layout::kJointState[joint], joint_[joint], out, out.joint_state);
  } else if (frame.id == layout::kWrench.id) {
    out.kind = MessageKind::kWrench;
    Read(frame, layout::kWrench, wrench_, out, out.wrench);
  } else if (frame.id == layout::kCommand.id) {
    out.kind = MessageKind::kCommand;
    Read(frame, layout::kCommand, command_, out, out.command);
  } else {
    out.reject = Reject::kUnknownId;
  }
  counters_.lost += out.lost;
  ++(out.reject == Reject::kNone ? counters_.accepted
                                 : counters_.rejected[static_cast<std::size_t>(out.reject)]);
  return out;
}

}  // namespace reed::bus
