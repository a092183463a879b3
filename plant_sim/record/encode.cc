#include "reed/plant/record/encode.h"

namespace reed::plant {
namespace {

void Fill(const PlantRecord& in, plant_t& out) {
  out.utime = in.utime;
  out.cycle = in.cycle;
  const std::int32_t count = out.dof = in.dof;
  REED_PLANT_T(REED_COPY)
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

void Fill(const WireRecord& r, wire_t& m) {
  m.utime = r.utime;
  m.cycle = r.cycle;
  m.answers_us = r.answers_us;
  m.command_us = r.command_us;
  m.foreign_s = r.foreign_s;
  m.dropped = r.dropped;
  m.computed_answers_us = r.computed_answers_us;
  m.computed_command_us = r.computed_command_us;
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
  if (const auto* wire = std::get_if<WireRecord>(&record)) {
    Fill(*wire, wire_);
    return Pack(kWireChannel, wire_);
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
