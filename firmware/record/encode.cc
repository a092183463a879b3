#include "reed/firmware/record/encode.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace reed::telemetry {
namespace {

constexpr std::size_t kMaxTextBytes = 256;  // one line for people

std::int32_t Joints(const Snapshot& snapshot) { return std::clamp(snapshot.dof, 0, kMaxJoints); }

/// "; last three cycles, receive/compute/transmit: 400.1/12.3/4.0, … us"
void AppendPhases(const rt::PhaseHistory& history, std::string& text) {
  text += "; last three cycles, receive/compute/transmit:";
  for (const rt::PhaseTimes& cycle : history) {
    std::array<char, 64> line{};
    std::snprintf(line.data(), line.size(), "%s %.1f/%.1f/%.1f", &cycle == &history.front() ? "" : ",",
                  1e-3 * cycle[0], 1e-3 * cycle[1], 1e-3 * cycle[2]);
    text += line.data();
  }
  text += " us";
}

}  // namespace

template <typename Message>
Bytes MessageEncoder::Encode(const Message& message) {
  const int size = message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
  if (size < 0) throw std::length_error(std::string(Message::getTypeName()) + " does not fit one datagram");
  return {buffer_.data(), static_cast<std::size_t>(size)};
}

Bytes MessageEncoder::Measured(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Measured& in = snapshot.measured;
  reed::measured_t& out = measured_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  const std::int32_t count = out.dof = Joints(snapshot);
  REED_MEASURED_T(REED_COPY)
  return Encode(out);
}

Bytes MessageEncoder::Control(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Control& in = snapshot.control;
  reed::control_t& out = control_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  const std::int32_t count = out.dof = Joints(snapshot);
  REED_CONTROL_T(REED_COPY)
  return Encode(out);
}

Bytes MessageEncoder::Adaptation(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Adaptation& in = snapshot.adaptation;
  reed::adaptation_t& out = adaptation_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  const std::int32_t count = out.num = std::clamp(snapshot.num_parameters, 0, kMaxParameters);
  REED_ADAPTATION_T(REED_COPY)
  return Encode(out);
}

Bytes MessageEncoder::Timing(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Timing& in = snapshot.timing;
  reed::timing_t& out = timing_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  constexpr std::int32_t count = 0;  // no arrays
  REED_TIMING_T(REED_COPY)
  return Encode(out);
}

Bytes MessageEncoder::Law(const Snapshot& snapshot, std::int64_t utime) {
  law_.utime = utime;
  law_.cycle = snapshot.cycle;
  law_.num = std::clamp(snapshot.num_law_values, 0, kMaxLawValues);
  field::CopyField(snapshot.law_values, law_.num, law_.values);
  return Encode(law_);
}

Bytes MessageEncoder::LawNames(const std::vector<std::string>& names, std::int64_t utime) {
  return Encode(reed::law_names_t{utime, static_cast<std::int32_t>(names.size()), names});
}

Bytes MessageEncoder::Bus(const BusCounters& in, std::int64_t cycle, std::int64_t utime) {
  reed::bus_t& out = bus_;
  out.utime = utime;
  out.cycle = cycle;
  constexpr std::int32_t count = 0;  // no arrays
  REED_BUS_T(REED_COPY)
  return Encode(out);
}

Bytes MessageEncoder::Event(const Snapshot& snapshot, int index, const char* text, std::int64_t utime) {
  const telemetry::Event& in = snapshot.events.at(static_cast<std::size_t>(index));
  reed::event_t& out = event_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  out.mode = in.mode;
  out.force_source = in.force_source;
  out.code = in.code;
  out.joint = in.joint;
  out.value = in.value;
  out.text.assign(text, strnlen(text, kMaxTextBytes));
  if (in.about_time) AppendPhases(snapshot.phase_history, out.text);
  return Encode(out);
}

Bytes MessageEncoder::Histogram(const reed::histogram_t& histogram) { return Encode(histogram); }

Bytes MessageEncoder::Run(const reed::run_t& run) { return Encode(run); }

}  // namespace reed::telemetry
