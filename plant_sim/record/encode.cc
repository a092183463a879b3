#include "reed/plant/record/encode.h"

#include <algorithm>

namespace reed::plant {
namespace {

void FillJoints(const std::array<double, kMaxJoints>& from, std::int32_t dof, std::vector<double>& to) {
  to.assign(from.begin(), from.begin() + dof);
}

void Fill(const PlantRecord& r, plant_t& m) {
  m.utime = r.utime;
  m.cycle = r.cycle;
  m.t_s = r.t_s;
  m.dof = r.dof;
  FillJoints(r.motor_angle, r.dof, m.motor_angle);
  FillJoints(r.motor_speed, r.dof, m.motor_speed);
  FillJoints(r.joint_angle, r.dof, m.joint_angle);
  FillJoints(r.torque, r.dof, m.torque);
  m.braked = static_cast<std::int8_t>(r.braked);
  std::copy(r.tip.begin(), r.tip.end(), m.tip);
  std::copy(r.tip_velocity.begin(), r.tip_velocity.end(), m.tip_velocity);
  std::copy(r.contact_force.begin(), r.contact_force.end(), m.contact_force);
  m.normal_force = r.normal_force;
  m.gap = r.gap;
  m.kinetic_J = r.kinetic_J;
  m.elastic_J = r.elastic_J;
  m.potential_J = r.potential_J;
  m.stalls = r.host_pauses;
  m.stood_s = r.host_pause_s;
}

void Fill(const EventRecord& r, event_t& m) {
  m.utime = r.utime;
  m.cycle = r.cycle;
  m.mode = r.mode;
  m.force_source = 0;
  m.code = static_cast<std::int32_t>(r.code);
  m.joint = -1;
  m.value = r.value;
  m.text = r.text.data();
}

void Fill(const ShapeRecord& r, shape_t& m) {
  m.utime = r.utime;
  m.cycle = r.cycle;
  m.num = static_cast<std::int32_t>(r.num);
  const auto copy = [&](const auto& from, std::vector<float>& to) {
    to.assign(from.data(), from.data() + r.num);
  };
  copy(r.bent[0], m.x), copy(r.bent[1], m.y), copy(r.bent[2], m.z);
  copy(r.rigid[0], m.rigid_x), copy(r.rigid[1], m.rigid_y), copy(r.rigid[2], m.rigid_z);
}

}  // namespace

Message MessageEncoder::Encode(const Record& record) {
  if (const auto* plant = std::get_if<PlantRecord>(&record)) {
    Fill(*plant, plant_);
    return Pack(kPlantChannel, plant_);
  }
  if (const auto* shape = std::get_if<ShapeRecord>(&record)) {
    Fill(*shape, shape_);
    return Pack(kShapeChannel, shape_);
  }
  Fill(std::get<EventRecord>(record), event_);
  return Pack(kPlantEventChannel, event_);
}

template <typename T>
Message MessageEncoder::Pack(const char* channel, const T& message) {
  buffer_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
  return {channel, message.utime, buffer_};
}

}  // namespace reed::plant
