// The arm as seen through frames: SYNC out, states and wrench in, command out. Every frame that passes is
// shown to the tap, so that the CAN log is what the controller saw. RT: safe.
#pragma once

#include <algorithm>
#include <bit>
#include <span>

#include "reed/bus/codec/codec.h"
#include "reed/bus/transport/transport.h"
#include "reed/core/controller.h"
#include "reed/firmware/snapshot/snapshot.h"
#include "reed/rt/clock.h"

namespace reed {

static_assert(static_cast<int>(DriveState::kFault) == static_cast<int>(bus::DriveState::kFault) &&
              static_cast<int>(DriveState::kBraked) == static_cast<int>(bus::DriveState::kBraked) &&
              static_cast<int>(DriveRequest::kEnable) == static_cast<int>(bus::DriveRequest::kEnable));

template <int N>
class ArmBus {
 public:
  /// transport and codec outlive this object.
  ArmBus(bus::Transport& transport, bus::ControllerCodec& codec) : transport_(transport), codec_(codec) {
    measurement_.age.fill(Measurement<N>::kNever);
  }

  /// Starts a cycle: the joints sample on this frame. Everything known so far is one cycle older.
  void SendSync(std::uint32_t cycle, telemetry::Snapshot& tap) noexcept {
    cycle_ = cycle;
    answered_ = 0;
    wrench_came_ = wrench_heard_ = false;
    measurement_.foreign_controller = false;
    measurement_.unexpected_joint = -1;
    for (int& age : measurement_.age) age = std::min(age + 1, Measurement<N>::kNever);
    measurement_.wrench_age = std::min(measurement_.wrench_age + 1, Measurement<N>::kNever);
    Send(codec_.Start(cycle), 0, tap);
  }

  /// Takes frames until every joint has answered this cycle's SYNC, and the wrench if one came last cycle, or
  /// the deadline passes. True if all joints answered. A babbling bus cannot hold the loop: what is more than
  /// kMostFrames waits for the next cycle.
  bool Receive(std::int64_t deadline_ns, telemetry::Snapshot& tap) noexcept {
    std::int64_t wait_end_ns = std::min(deadline_ns, tap.time_ns + kOneWait_ns);
    for (int taken = 0; taken < kMostFrames && Missing() > 0;) {
      const std::uint64_t passed_over = PassedOver();
      const int count = transport_.Receive(received_, Missing(), wait_end_ns);
      const std::int64_t now_ns = rt::MonotonicClock{}.NowNs();  // one batch, one reading
      const std::int32_t at_ns = rt::ShortNs(now_ns - tap.time_ns);
      if (count == 0) {
        if (now_ns < wait_end_ns && PassedOver() != passed_over)
          continue;                                 // others' frames: it looked at enough of them
        const bool gave_up = now_ns < wait_end_ns;  // the transport itself: nothing can come any more
        if (wait_end_ns == deadline_ns || MissingJoints() == 0 || gave_up) break;
      }
      for (int i = 0; i < count; ++i) Take(received_[static_cast<std::size_t>(i)], at_ns, tap);
      taken += count;
      wait_end_ns = std::min(deadline_ns, now_ns + kOneWait_ns);
    }
    wrench_expected_ = wrench_heard_;
    return MissingJoints() == 0;
  }

  /// `at_ns`: time since the cycle's start, for the record. Returns the first joint whose torque is beyond what the
  /// frame carries, so that the drive gets another one; -1: none.
  int SendCommand(const Command<N>& command, std::int64_t at_ns, telemetry::Snapshot& tap) noexcept {
    bus::CommandMessage message{cycle_, static_cast<bus::DriveRequest>(command.request), {}};
    for (int i = 0; i < N; ++i) message.torque_Nm[static_cast<std::size_t>(i)] = command.torque[i];
    Send(codec_.Command(message), rt::ShortNs(at_ns), tap);
    return codec_.CutTorque();
  }

  const Measurement<N>& measurement() const noexcept { return measurement_; }
  const bus::DecodeCounters& decode_counters() const noexcept { return codec_.counters(); }
  const bus::TransportCounters& transport_counters() const noexcept { return transport_.counters(); }
  bool alive() const noexcept { return transport_.alive(); }
  std::int64_t late_frames() const noexcept { return late_; }

 private:
  static constexpr int kMostFrames = 96;  // of one cycle: several whole answers after a delay
  /// Only lockstep waits for longer, and only for joints: the wrench travels with them, and one that is not
  /// there by then was not sent.
  static constexpr std::int64_t kOneWait_ns = 100'000'000;

  std::uint64_t PassedOver() const noexcept { return bus::PassedOver(transport_.counters()); }
  int MissingJoints() const noexcept { return N - std::popcount(answered_); }
  int Missing() const noexcept { return MissingJoints() + (wrench_expected_ && !wrench_came_ ? 1 : 0); }

  void Send(std::span<const bus::Frame> frames, std::int32_t at_ns, telemetry::Snapshot& tap) noexcept {
    if (frames.empty()) return;
    transport_.Send(frames);
    for (const bus::Frame& frame : frames) tap.AddFrame(frame, telemetry::Direction::kSent, at_ns);
  }

  void Take(const bus::Frame& frame, std::int32_t at_ns, telemetry::Snapshot& tap) noexcept {
    tap.AddFrame(frame, telemetry::Direction::kReceived, at_ns);
    const bus::Decoded decoded = codec_.Read(frame);
    switch (decoded.kind) {
      case bus::MessageKind::kJointState:
        TakeJoint(decoded);
        break;
      case bus::MessageKind::kWrench:
        TakeWrench(decoded);
        break;
      case bus::MessageKind::kSync:
      case bus::MessageKind::kCommand:
        measurement_.foreign_controller = measurement_.foreign_controller || bus::IsGenuine(decoded);
        break;
      case bus::MessageKind::kUnknown:
        break;
    }
  }

  void TakeJoint(const bus::Decoded& decoded) noexcept {
    if (decoded.joint >= N) {
      if (decoded.reject == bus::Reject::kNone) measurement_.unexpected_joint = decoded.joint;
      return;
    }
    const std::size_t i = static_cast<std::size_t>(decoded.joint);
    if (decoded.reject != bus::Reject::kNone) {
      answered_ |= 1u << i;  // it came, but says nothing that may be used: the value stays and ages
      return;
    }
    const bus::JointStateMessage& state = decoded.joint_state;
    const int late =
        static_cast<int>((cycle_ - state.cycle_low4) & 0xFu);  // cycles since the SYNC it answers
    if (late == 0) {
      answered_ |= 1u << i;
    } else {
      ++late_;
    }
    if (late >= measurement_.age[i]) return;  // something newer is already known
    measurement_.theta[decoded.joint] = state.position_rad;
    measurement_.theta_dot[decoded.joint] = state.velocity_radps;
    measurement_.torque[decoded.joint] = state.torque_Nm;
    measurement_.drive[i] = static_cast<DriveState>(state.state);
    measurement_.age[i] = late;
  }

  /// A wrench that nobody waited for (the first after a loss) is not used: whether it is seen in this cycle
  /// or as a late one in the next is a race, and equal runs shall be equal. The next one is waited for.
  void TakeWrench(const bus::Decoded& decoded) noexcept {
    const bool waited_for = wrench_expected_;
    wrench_expected_ = wrench_heard_ = true;
    if (decoded.reject != bus::Reject::kNone) {
      wrench_came_ = true;  // it came, but says nothing that may be used
      return;
    }
    const bus::WrenchMessage& wrench = decoded.wrench;
    const auto late = static_cast<std::int32_t>(cycle_ - wrench.cycle);  // modulo 2^32
    if (late > 0) ++late_;
    wrench_came_ = wrench_came_ || late == 0;
    if (!waited_for || late < 0 || late >= measurement_.wrench_age) return;
    measurement_.force = Eigen::Map<const Eigen::Vector3d>(wrench.force_N.data());
    measurement_.moment = Eigen::Map<const Eigen::Vector3d>(wrench.moment_Nm.data());
    measurement_.wrench_saturated = wrench.saturated;
    measurement_.wrench_age = late;
  }

  bus::Transport& transport_;
  bus::ControllerCodec& codec_;
  Measurement<N> measurement_;
  std::array<bus::Frame, 32> received_{};
  std::uint32_t cycle_ = 0;
  std::uint32_t answered_ = 0;   // bit per joint
  bool wrench_came_ = false;     // this cycle's
  bool wrench_heard_ = false;    // any, in this cycle
  bool wrench_expected_ = true;  // worth waiting for
  std::int64_t late_ = 0;
};

}  // namespace reed
