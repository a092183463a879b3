// A second drive protocol, as far from Reed's as drives on the market are: identifiers of 29 bits, one frame per joint that
// carries the command and asks for the state, no SYNC, no protection. A cycle's command travels with the query of the next.
#pragma once

#include <array>
#include <cstring>

#include "reed/bus/codec/codec.h"

namespace reed::test {

inline constexpr std::uint32_t kQuery = 0x8001, kReply = 0x10001, kWrist = 0x10100;  // + joint

/// Numbers behind each other in a frame's bytes, the machine's own order.
class Bytes {
 public:
  explicit Bytes(const bus::Frame& frame) : data_(frame.data) {}
  Bytes() = default;

  template <typename T>
  Bytes& Put(T value) noexcept {
    std::memcpy(data_.data() + at_, &value, sizeof value);
    at_ += sizeof value;
    return *this;
  }
  template <typename T>
  T Get() noexcept {
    T value{};
    std::memcpy(&value, data_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  bus::Frame Frame(std::uint32_t id) const noexcept { return {id, 48, data_, true}; }

 private:
  std::array<std::uint8_t, 64> data_{};
  std::size_t at_ = 0;
};

inline bool Is(const bus::Frame& frame, std::uint32_t first, std::uint32_t count) noexcept {
  return frame.extended && frame.size == 48 && frame.id >= first && frame.id < first + count;
}

class PairedController final : public bus::ControllerCodec {
 public:
  explicit PairedController(int joints) : joints_(static_cast<std::uint32_t>(joints)) {}

  std::span<const bus::Frame> Start(std::uint32_t cycle) noexcept override {
    for (std::uint32_t i = 0; i < joints_; ++i)
      sent_[i] = Bytes()
                     .Put(cycle)
                     .Put(commanded_)
                     .Put(command_.cycle)
                     .Put(command_.request)
                     .Put(static_cast<float>(command_.torque_Nm[i]))
                     .Frame(kQuery + i);
    return std::span<const bus::Frame>(sent_).first(joints_);
  }
  int CutTorque() const noexcept override { return -1; }
  std::span<const bus::Frame> Command(const bus::CommandMessage& command) noexcept override {
    command_ = command;
    commanded_ = true;
    return {};
  }
  bus::Decoded Read(const bus::Frame& frame) noexcept override {
    bus::Decoded out;
    Bytes in(frame);
    if (Is(frame, kReply, joints_)) {
      out.kind = bus::MessageKind::kJointState;
      out.joint = static_cast<int>(frame.id - kReply);
      out.joint_state.position_rad = static_cast<double>(in.Get<float>());
      out.joint_state.velocity_radps = static_cast<double>(in.Get<float>());
      out.joint_state.torque_Nm = static_cast<double>(in.Get<float>());
      out.joint_state.state = in.Get<bus::DriveState>();
      out.joint_state.cycle_low4 = in.Get<std::uint8_t>();
    } else if (Is(frame, kWrist, 1)) {
      out.kind = bus::MessageKind::kWrench;
      out.wrench.cycle = in.Get<std::uint32_t>();
      for (double& f : out.wrench.force_N) f = static_cast<double>(in.Get<float>());
      for (double& m : out.wrench.moment_Nm) m = static_cast<double>(in.Get<float>());
    } else {
      out.reject = bus::Reject::kUnknownId;
    }
    ++(out.reject == bus::Reject::kNone ? counters_.accepted
                                        : counters_.rejected[static_cast<std::size_t>(out.reject)]);
    return out;
  }
  const bus::DecodeCounters& counters() const noexcept override { return counters_; }

 private:
  std::uint32_t joints_;
  bus::CommandMessage command_;
  bool commanded_ = false;
  std::array<bus::Frame, bus::kMostFramesAtOnce> sent_;
  bus::DecodeCounters counters_;
};

class PairedArm final : public bus::ArmCodec {
 public:
  explicit PairedArm(int joints) : joints_(static_cast<std::uint32_t>(joints)) {}

  /// The last joint's query completes the command of the cycle before, and starts its own.
  std::span<const bus::Decoded> Read(const bus::Frame& frame) noexcept override {
    if (!Is(frame, kQuery, joints_)) return {};
    Bytes in(frame);
    const auto cycle = in.Get<std::uint32_t>();
    const bool commanded = in.Get<bool>();
    command_.cycle = in.Get<std::uint32_t>();
    command_.request = in.Get<bus::DriveRequest>();
    command_.torque_Nm[frame.id - kQuery] = static_cast<double>(in.Get<float>());
    came_ = frame.id == kQuery ? 1 : came_ + 1;
    if (came_ != joints_ || frame.id != kQuery + joints_ - 1) return {};
    read_ = {};
    read_[0].kind = bus::MessageKind::kCommand;
    read_[0].command = command_;
    read_[1].kind = bus::MessageKind::kSync;
    read_[1].sync.cycle = cycle;
    return std::span<const bus::Decoded>(read_).subspan(commanded ? 0 : 1);
  }
  bus::Decoded ReadAfresh(const bus::Frame& frame) const noexcept override {
    bus::Decoded out;
    out.kind = bus::MessageKind::kSync;
    out.sync.cycle = Bytes(frame).Get<std::uint32_t>();
    return out;
  }
  void StartOver(const bus::Frame&) noexcept override {}
  std::span<const bus::Frame> Answer(std::span<const bus::JointStateMessage> joints,
                                     const bus::WrenchMessage* wrench) noexcept override {
    std::size_t size = 0;
    for (const bus::JointStateMessage& joint : joints) {
      sent_[size] = Bytes()
                        .Put(static_cast<float>(joint.position_rad))
                        .Put(static_cast<float>(joint.velocity_radps))
                        .Put(static_cast<float>(joint.torque_Nm))
                        .Put(joint.state)
                        .Put(joint.cycle_low4)
                        .Frame(kReply + static_cast<std::uint32_t>(size));
      ++size;
    }
    if (wrench != nullptr) {
      Bytes out;
      out.Put(wrench->cycle);
      for (const double f : wrench->force_N) out.Put(static_cast<float>(f));
      for (const double m : wrench->moment_Nm) out.Put(static_cast<float>(m));
      sent_[size++] = out.Frame(kWrist);
    }
    return std::span<const bus::Frame>(sent_).first(size);
  }

 private:
  std::uint32_t joints_, came_ = 0;
  bus::CommandMessage command_;
  std::array<bus::Decoded, 2> read_;
  std::array<bus::Frame, bus::kMostFramesAtOnce> sent_;
};

}  // namespace reed::test
