// A plant endpoint on a fake wire, on a body whose motion is known in closed form.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/plant/endpoint/lockstep_endpoint.h"
#include "reed/plant/endpoint/realtime_endpoint.h"
#include "reed/tests/support/fake_transport.h"
#include "reed_layout.h"

namespace reed::plant {

/// Free rotors: J q̈ = τ, integrated exactly; closed brakes stop them at once.
class RotorBody final : public ArmBody {
 public:
  static constexpr double kInertia_kgm2 = 0.5;

  void Reset(const Eigen::VectorXd& motor_angle_rad) override {
    truth_ = Truth{};
    truth_.motor_angle_rad = truth_.joint_angle_rad = motor_angle_rad;
    truth_.motor_speed_radps = Eigen::VectorXd::Zero(motor_angle_rad.size());
    truth_.contact_force_N = truth_.sensed_force_N = force_N;
    ++resets;
  }
  void Advance(const Eigen::VectorXd& tau, bool braked, double dt_s) override {
    if (braked) {
      truth_.motor_speed_radps.setZero();
    } else {
      truth_.motor_angle_rad += truth_.motor_speed_radps * dt_s + 0.5 * dt_s * dt_s / kInertia_kgm2 * tau;
      truth_.motor_speed_radps += dt_s / kInertia_kgm2 * tau;
    }
    truth_.t_s += dt_s;
    longest_step_s = std::max(longest_step_s, dt_s);
  }
  void ForceBrakes(std::uint32_t closed, std::uint32_t open) override { brakes = closed + 65536.0 * open; }
  void StartSchedule() override { schedule_from_s = truth_.t_s; }
  const Truth& truth() const override { return truth_; }
  const ArmShape& Shape() override {
    shape_.bent = {Eigen::Vector3d::Zero(), truth_.tip_m};
    shape_.rigid = {Eigen::Vector3d::Zero(), Eigen::Vector3d(truth_.motor_angle_rad[0], 0.0, 0.0)};
    return shape_;
  }
  bool healthy() const override { return truth_.t_s < sick_from_s; }
  std::string fault_description() const override {
    return healthy() ? "" : "motor 1 speed is not finite at 0.005 s";
  }

  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  double sick_from_s = 1e9;
  double longest_step_s = 0.0;
  double brakes = 0.0;  // stuck ones
  double schedule_from_s = -1.0;
  int resets = 0;

 private:
  Truth truth_;
  ArmShape shape_;
};

class VectorRecorder final : public RecordSink {
 public:
  void Put(const Record& record) noexcept override { records.push_back(record); }

  std::vector<PlantRecord> Plants() const { return All<PlantRecord>(); }
  std::vector<ShapeRecord> Shapes() const { return All<ShapeRecord>(); }
  std::vector<EventRecord> Events() const { return All<EventRecord>(); }
  int Count(PlantEvent code) const {
    int count = 0;
    for (const EventRecord& event : Events()) count += event.code == code ? 1 : 0;
    return count;
  }

  std::vector<Record> records;

 private:
  template <typename T>
  std::vector<T> All() const {
    std::vector<T> out;
    for (const Record& record : records) {
      if (const T* r = std::get_if<T>(&record)) out.push_back(*r);
    }
    return out;
  }
};

/// What came back for one SYNC.
struct Answer {
  std::vector<bus::JointStateMessage> joints;
  std::vector<bus::WrenchMessage> wrenches;
  std::vector<std::uint32_t> ids;
  std::vector<bus::Frame> frames;
};

/// The controller's side of the wire, spoken frame by frame.
class FakeController {
 public:
  explicit FakeController(test::FakeTransport& transport) : transport_(transport) {}

  void Sync(std::uint32_t cycle, std::uint8_t layout = bus::layout::kLayoutId) {
    Send(encoder_.Sync({cycle, layout}));
  }
  void Command(std::uint32_t cycle, bus::DriveRequest request, double tau_Nm = 0.0) {
    Send(CommandFrame(cycle, request, tau_Nm));
  }
  bus::Frame CommandFrame(std::uint32_t cycle, bus::DriveRequest request, double tau_Nm) {
    bus::CommandMessage message;
    message.cycle = cycle;
    message.request = request;
    message.torque_Nm.fill(tau_Nm);
    return encoder_.Command(message);
  }
  void Send(const bus::Frame& frame) { transport_.Send(std::span(&frame, 1)); }

  Answer Take() {
    Answer answer;
    for (const bus::Frame& frame : transport_.inbox()) {
      const bus::Decoded d = decoder_.Decode(frame);
      EXPECT_EQ(d.reject, bus::Reject::kNone);
      answer.ids.push_back(frame.id);
      answer.frames.push_back(frame);
      if (d.kind == bus::MessageKind::kJointState) answer.joints.push_back(d.joint_state);
      if (d.kind == bus::MessageKind::kWrench) answer.wrenches.push_back(d.wrench);
    }
    transport_.inbox().clear();
    return answer;
  }

 private:
  test::FakeTransport& transport_;
  bus::FrameEncoder encoder_;
  bus::Decoder decoder_;
};

inline PlantConfig TwoJointScenario() {
  PlantConfig scenario;
  scenario.arm.name = "rotors";
  scenario.arm.joints.resize(2);
  scenario.arm.torque_limit_Nm = {40.0, 8.0};
  scenario.start_rad = {0.25, -1.0};
  return scenario;
}

}  // namespace reed::plant
