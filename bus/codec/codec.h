// What a drive protocol is to the two programs. The controller's side turns a cycle and a command into frames and
// frames into what the arm says; the arm's side does the opposite. Reed's own protocol is in reed_codec.h. Another one,
// with other identifiers or with command and query in one frame, implements both classes and nothing else changes.
// RT: every call is safe (no allocation, no throw).
#pragma once

#include <cstddef>
#include <span>

#include "reed/bus/codec/messages.h"

namespace reed::bus {

/// That one call builds: every joint and the wrist.
inline constexpr std::size_t kMostFramesAtOnce = kMaxJoints + 1;

class ControllerCodec {
 public:
  virtual ~ControllerCodec() = default;
  /// The frames with which a cycle starts; the joints sample on the last of them. Valid until the next call.
  virtual std::span<const Frame> Start(std::uint32_t cycle) noexcept = 0;
  /// The frames that carry a command; none where it travels with the next Start. Valid until the next call.
  virtual std::span<const Frame> Command(const CommandMessage& command) noexcept = 0;
  /// Of the last command: the first joint whose torque is beyond what the frame carries, so that its drive gets another one;
  /// -1: none.
  virtual int CutTorque() const noexcept = 0;
  /// What a frame says.
  virtual Decoded Read(const Frame& frame) noexcept = 0;
  virtual const DecodeCounters& counters() const noexcept = 0;
};

class ArmCodec {
 public:
  virtual ~ArmCodec() = default;
  /// What a frame says, in order: a command and the start of the cycle after it may be in one. Valid until the next
  /// call.
  virtual std::span<const Decoded> Read(const Frame& frame) noexcept = 0;
  /// A start as it reads without what came before: from a controller that was started anew.
  virtual Decoded ReadAfresh(const Frame& frame) const noexcept = 0;
  /// Such a controller is there: what its predecessor sent is forgotten, and `frame` is its first.
  virtual void StartOver(const Frame& frame) noexcept = 0;
  /// A state per joint, and the wrench where there is one. Valid until the next call.
  virtual std::span<const Frame> Answer(std::span<const JointStateMessage> joints,
                                        const WrenchMessage* wrench) noexcept = 0;
};

}  // namespace reed::bus
