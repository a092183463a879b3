#include "reed/plant/endpoint/bus_port.h"

#include <utility>

#include "reed/bus/codec/reed_codec.h"

namespace reed::plant {

BusPort::BusPort(bus::Transport& transport, std::unique_ptr<bus::ArmCodec> codec)
    : transport_(transport),
      codec_(codec != nullptr ? std::move(codec) : std::make_unique<bus::ReedArmCodec>()) {}

std::span<const Incoming> BusPort::Receive(std::int64_t deadline_ns) noexcept {
  received_ = transport_.Receive(frames_, 1, deadline_ns);
  std::size_t used = 0;
  for (int i = 0; i < received_; ++i) {
    const bus::Frame& frame = frames_[static_cast<std::size_t>(i)];
    for (const bus::Decoded& decoded : codec_->Read(frame)) {
      const auto in = Read(frame, decoded);
      if (in && used < incoming_.size()) incoming_[used++] = *in;
    }
  }
  return std::span(incoming_).first(used);
}

std::optional<Incoming> BusPort::Read(const bus::Frame& frame, const bus::Decoded& decoded) noexcept {
  if (decoded.kind == bus::MessageKind::kSync) return ReadSync(frame, decoded);
  if (decoded.kind == bus::MessageKind::kCommand && decoded.reject == bus::Reject::kNone) {
    Incoming in;
    in.kind = Incoming::Kind::kCommand;
    in.command = decoded.command;
    return in;
  }
  if (decoded.reject != bus::Reject::kNone) ++rejected_;
  const bool of_an_arm =
      decoded.kind == bus::MessageKind::kJointState || decoded.kind == bus::MessageKind::kWrench;
  if (of_an_arm && bus::IsGenuine(decoded)) another_arm_ = true;
  return std::nullopt;
}

/// A controller that was started anew begins its counters anew, so its first frames look repeated or out of
/// sequence to a receiver that followed its predecessor. A SYNC moves nothing by itself; it is therefore read
/// afresh, and its cycle number tells a restart (not soon after the last one) from a gap (soon after it). The same
/// frame twice is neither, except that the first one of a run may be the first of a second run: answering t =
/// 0 once more harms nobody.
std::optional<Incoming> BusPort::ReadSync(const bus::Frame& frame, const bus::Decoded& decoded) noexcept {
  const bus::Decoded own = codec_->ReadAfresh(frame);
  const bool repeated = decoded.reject == bus::Reject::kRepeated;
  if (own.reject != bus::Reject::kNone ||
      (repeated && last_cycle_ == own.sync.cycle && first_cycle_ != own.sync.cycle)) {
    ++rejected_;
    return std::nullopt;
  }
  Incoming in;
  in.kind = Incoming::Kind::kSync;
  in.sync = own.sync;
  const std::uint32_t ahead =
      own.sync.cycle - last_cycle_.value_or(own.sync.cycle);  // modulo 2^32, as the number is
  in.new_controller = ahead == 0 || ahead > kLongestGap;
  if (in.new_controller) {
    codec_->StartOver(frame);
    first_cycle_ = own.sync.cycle;
  }
  count_ = in.new_controller ? own.sync.cycle : count_ + ahead;
  in.count = count_;
  last_cycle_ = own.sync.cycle;
  return in;
}

void BusPort::Answer(std::uint32_t cycle, const Measurement& measurement) noexcept {
  std::array<bus::JointStateMessage, kMaxJoints> joints = measurement.joints;
  for (bus::JointStateMessage& joint : joints) joint.cycle_low4 = static_cast<std::uint8_t>(cycle & 0xFU);
  bus::WrenchMessage wrench;
  wrench.cycle = cycle;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    wrench.force_N[axis] = measurement.wrench.force_N[static_cast<Eigen::Index>(axis)];
    wrench.moment_Nm[axis] = measurement.wrench.moment_Nm[static_cast<Eigen::Index>(axis)];
  }
  wrench.saturated = measurement.wrench.saturated;
  transport_.Send(codec_->Answer(std::span(joints).first(static_cast<std::size_t>(measurement.dof)),
                                 measurement.wrench_lost ? nullptr : &wrench));
}

}  // namespace reed::plant
