// A frame whose content is another one, with the protection that its sender would have given it. RT: safe.
#pragma once

#include <cstdint>

#include "reed/bus/codec/messages.h"
#include "reed/bus/codec/reprotect.h"

namespace reed::plant {

/// What is changed in a frame: its first value (position, force along z, first torque), and the cycle that it names.
struct Change {
  double value = 0.0;
  int cycles = 0;
};

inline bus::Frame Altered(const bus::Frame& frame, const Change& change) noexcept {
  bus::Decoder reader;  // without predecessor: it follows nobody's counter
  bus::Decoded read = reader.Decode(frame);
  if (read.reject != bus::Reject::kNone) return frame;
  bus::FrameEncoder writer;
  bus::Frame out = frame;
  switch (read.kind) {
    case bus::MessageKind::kSync:
      read.sync.cycle += static_cast<std::uint32_t>(change.cycles);
      out = writer.Sync(read.sync);
      break;
    case bus::MessageKind::kJointState:
      read.joint_state.position_rad += change.value;
      read.joint_state.cycle_low4 =
          static_cast<std::uint8_t>((read.joint_state.cycle_low4 + change.cycles) & 0xF);
      out = writer.JointState(read.joint, read.joint_state);
      break;
    case bus::MessageKind::kWrench:
      read.wrench.force_N[2] += change.value;
      read.wrench.cycle += static_cast<std::uint32_t>(change.cycles);
      out = writer.Wrench(read.wrench);
      break;
    case bus::MessageKind::kCommand:
      read.command.torque_Nm[0] += change.value;
      read.command.cycle += static_cast<std::uint32_t>(change.cycles);
      out = writer.Command(read.command);
      break;
    case bus::MessageKind::kUnknown:
      return frame;
  }
  bus::Reprotect(out, bus::CounterOf(frame));
  return out;
}

}  // namespace reed::plant
