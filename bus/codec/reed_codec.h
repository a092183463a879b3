// The frames of bus/reed.dbc as a drive protocol: SYNC, a state per joint, the wrench, one command for all joints. RT: safe.
#pragma once

#include <array>

#include "reed/bus/codec/codec.h"

namespace reed::bus {

class ReedControllerCodec final : public ControllerCodec {
 public:
  std::span<const Frame> Start(std::uint32_t cycle) noexcept override;
  std::span<const Frame> Command(const CommandMessage& command) noexcept override;
  int CutTorque() const noexcept override { return cut_; }
  Decoded Read(const Frame& frame) noexcept override;
  const DecodeCounters& counters() const noexcept override { return decoder_.counters(); }

 private:
  FrameEncoder encoder_;
  Decoder decoder_;
  Frame sent_;
  int cut_ = -1;
};

class ReedArmCodec final : public ArmCodec {
 public:
  std::span<const Decoded> Read(const Frame& frame) noexcept override;
  Decoded ReadAfresh(const Frame& frame) const noexcept override;
  void StartOver(const Frame& frame) noexcept override;
  std::span<const Frame> Answer(std::span<const JointStateMessage> joints,
                                const WrenchMessage* wrench) noexcept override;

 private:
  FrameEncoder encoder_;
  Decoder decoder_;
  Decoded read_;
  std::array<Frame, kMostFramesAtOnce> sent_;
};

}  // namespace reed::bus
