#include "reed/bus/codec/reed_codec.h"

namespace reed::bus {
namespace {

int FirstBeyondFrame(const CommandMessage& command) noexcept {
  for (std::size_t i = 0; i < command.torque_Nm.size(); ++i) {
    const Bounds carried = layout::kCommandTorque[i];
    if (command.torque_Nm[i] < carried.min || command.torque_Nm[i] > carried.max) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

std::span<const Frame> ReedControllerCodec::Start(std::uint32_t cycle) noexcept {
  sent_ = encoder_.Sync({cycle, layout::kLayoutId});
  return {&sent_, 1};
}

std::span<const Frame> ReedControllerCodec::Command(const CommandMessage& command) noexcept {
  const std::uint64_t before = encoder_.counters().clamped;
  sent_ = encoder_.Command(command);
  cut_ = encoder_.counters().clamped == before ? -1 : FirstBeyondFrame(command);
  return {&sent_, 1};
}

Decoded ReedControllerCodec::Read(const Frame& frame) noexcept { return decoder_.Decode(frame); }

std::span<const Decoded> ReedArmCodec::Read(const Frame& frame) noexcept {
  read_ = decoder_.Decode(frame);
  return {&read_, 1};
}

Decoded ReedArmCodec::ReadAfresh(const Frame& frame) const noexcept { return Decoder().Decode(frame); }

void ReedArmCodec::StartOver(const Frame& frame) noexcept {
  decoder_ = Decoder();
  decoder_.Decode(frame);
}

std::span<const Frame> ReedArmCodec::Answer(std::span<const JointStateMessage> joints,
                                            const WrenchMessage* wrench) noexcept {
  std::size_t size = 0;
  for (const JointStateMessage& joint : joints) {
    sent_[size] = encoder_.JointState(static_cast<int>(size), joint);
    ++size;
  }
  if (wrench != nullptr) sent_[size++] = encoder_.Wrench(*wrench);
  return std::span<const Frame>(sent_).first(size);
}

}  // namespace reed::bus
