#include "reed/firmware/record/encode.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace reed::telemetry {
namespace {

constexpr std::size_t kMaxTextBytes = 256;  // one line for people

/// The first `count` entries; resizing allocates the first time only.
template <typename T, typename U, std::size_t N>
void Assign(std::vector<T>& out, const std::array<U, N>& in, std::int32_t count) {
  out.assign(in.begin(), in.begin() + count);
}

void Assign(double (&out)[3], const Vec3& in) { std::copy(in.begin(), in.end(), out); }

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
  const std::int32_t dof = std::clamp(snapshot.dof, 0, kMaxJoints);
  out.utime = utime;
  out.cycle = snapshot.cycle;
  out.dof = dof;
  Assign(out.position, in.position, dof);
  Assign(out.velocity, in.velocity, dof);
  Assign(out.torque, in.torque, dof);
  Assign(out.age, in.age, dof);
  Assign(out.drive_state, in.drive_state, dof);
  Assign(out.force, in.force);
  Assign(out.moment, in.moment);
  out.wrench_age = in.wrench_age;
  return Encode(out);
}

Bytes MessageEncoder::Control(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Control& in = snapshot.control;
  reed::control_t& out = control_;
  const std::int32_t dof = std::clamp(snapshot.dof, 0, kMaxJoints);
  out.utime = utime;
  out.cycle = snapshot.cycle;
  out.t_s = in.t_s;
  out.mode = in.mode;
  out.force_source = in.force_source;
  out.dof = dof;
  Assign(out.theta_plan, in.theta_plan, dof);
  Assign(out.theta_d, in.theta_d, dof);
  Assign(out.theta_d_dot, in.theta_d_dot, dof);
  Assign(out.e, in.e, dof);
  Assign(out.s, in.s, dof);
  Assign(out.v, in.v, dof);
  Assign(out.v_dot, in.v_dot, dof);
  Assign(out.tau_law, in.tau_law, dof);
  Assign(out.tau, in.tau, dof);
  Assign(out.D, in.D, dof);
  Assign(out.normal, in.normal);
  out.f_d = in.f_d;
  out.f = in.f;
  out.e_f = in.e_f;
  out.e_f_integral = in.e_f_integral;
  out.z = in.z;
  Assign(out.tip_plan, in.tip_plan);
  Assign(out.observer, in.observer, dof);
  out.k_hat_e = in.k_hat_e;
  out.limits = in.limits;
  return Encode(out);
}

Bytes MessageEncoder::Adaptation(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Adaptation& in = snapshot.adaptation;
  reed::adaptation_t& out = adaptation_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  out.num = std::clamp(snapshot.num_parameters, 0, kMaxParameters);
  Assign(out.p_hat, in.p_hat, out.num);
  Assign(out.eta_hat, in.eta_hat, out.num);
  out.sigma0 = in.sigma0;
  out.sigma1 = in.sigma1;
  return Encode(out);
}

Bytes MessageEncoder::Timing(const Snapshot& snapshot, std::int64_t utime) {
  const telemetry::Timing& in = snapshot.timing;
  reed::timing_t& out = timing_;
  out.utime = utime;
  out.cycle = snapshot.cycle;
  out.wake_ns = in.wake_ns;
  out.rx_ns = in.rx_ns;
  out.compute_ns = in.compute_ns;
  out.tx_ns = in.tx_ns;
  out.cycle_ns = in.cycle_ns;
  out.missed = in.missed;
  out.missed_host_paused = in.missed_host_paused;
  out.overruns = in.overruns;
  out.dropped = in.dropped;
  out.rx_over = in.rx_over;
  out.compute_over = in.compute_over;
  out.tx_over = in.tx_over;
  return Encode(out);
}

Bytes MessageEncoder::Bus(const BusCounters& in, std::int64_t cycle, std::int64_t utime) {
  reed::bus_t& out = bus_;
  out.utime = utime;
  out.cycle = cycle;
  out.frames_rx = in.frames_rx;
  out.frames_tx = in.frames_tx;
  out.lost = in.lost;
  out.crc_errors = in.crc_errors;
  out.repeated = in.repeated;
  out.wrong_sequence = in.wrong_sequence;
  out.wrong_length = in.wrong_length;
  out.out_of_range = in.out_of_range;
  out.unknown_id = in.unknown_id;
  out.malformed = in.malformed;
  out.error_frames = in.error_frames;
  out.overflowed = in.overflowed;
  out.tx_refused = in.tx_refused;
  out.late = in.late;
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
