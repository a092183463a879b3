// A snapshot in which every number differs from every other and follows from (field, joint, cycle), so that
// any field that lands in the wrong place shows. test_recorded_files.py knows the same rule.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reed/firmware/snapshot/snapshot.h"

namespace reed::test {

inline double Value(int field, int index, std::int64_t cycle) {
  return 100.0 * field + index + 0.0009765625 * static_cast<double>(cycle);
}

template <typename Array>
void Fill(Array& out, int field, std::int64_t cycle) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<typename Array::value_type>(Value(field, static_cast<int>(i), cycle));
  }
}

/// 16 bytes as a joint's state frame has: the cycle's low byte first, then a ramp.
inline bus::Frame SampleFrame(std::uint32_t id, std::int64_t cycle) {
  bus::Frame frame{id, 16, {}};
  for (std::size_t i = 0; i < 16; ++i)
    frame.data[i] = static_cast<std::uint8_t>(cycle + static_cast<int>(i) + id);
  return frame;
}

inline telemetry::Snapshot SampleSnapshot(std::int64_t cycle, int dof, int num_parameters) {
  telemetry::Snapshot s;
  s.cycle = cycle;
  s.time_ns = 1'000'000'000 + cycle * 1'000'000;
  s.dof = dof;
  s.num_parameters = num_parameters;

  telemetry::Measured& m = s.measured;
  Fill(m.position, 1, cycle);
  Fill(m.velocity, 2, cycle);
  Fill(m.torque, 3, cycle);
  for (std::size_t i = 0; i < m.age.size(); ++i) {
    m.age[i] = static_cast<std::int32_t>(cycle % 7 + static_cast<int>(i));
    m.drive_state[i] = static_cast<std::int8_t>(i % 5);
  }
  Fill(m.force, 4, cycle);
  Fill(m.moment, 5, cycle);
  m.wrench_age = static_cast<std::int32_t>(cycle % 3);

  telemetry::Control& c = s.control;
  c.t_s = Value(6, 0, cycle);
  c.mode = 2;
  c.force_source = 1;
  Fill(c.theta_plan, 7, cycle);
  Fill(c.theta_d, 8, cycle);
  Fill(c.theta_d_dot, 9, cycle);
  Fill(c.e, 10, cycle);
  Fill(c.s, 11, cycle);
  Fill(c.v, 12, cycle);
  Fill(c.v_dot, 13, cycle);
  Fill(c.tau_law, 14, cycle);
  Fill(c.tau, 15, cycle);
  Fill(c.D, 16, cycle);
  Fill(c.normal, 17, cycle);
  c.f_d = Value(18, 0, cycle);
  c.f = Value(19, 0, cycle);
  c.e_f = Value(20, 0, cycle);
  c.e_f_integral = Value(21, 0, cycle);
  c.z = Value(22, 0, cycle);
  Fill(c.tip_plan, 23, cycle);
  Fill(c.observer, 24, cycle);
  c.k_hat_e = Value(25, 0, cycle);
  c.limits = static_cast<std::int32_t>(cycle & 0x3F);

  Fill(s.adaptation.p_hat, 26, cycle);
  Fill(s.adaptation.eta_hat, 27, cycle);
  s.adaptation.sigma0 = Value(28, 0, cycle);
  s.adaptation.sigma1 = Value(29, 0, cycle);

  s.timing = {101, 102, 103, 104, 105, cycle + 106, cycle + 107, cycle + 108, cycle + 109};
  s.bus = {cycle + 1, cycle + 2, cycle + 3,  cycle + 4,  cycle + 5,  cycle + 6,  cycle + 7,
           cycle + 8, cycle + 9, cycle + 10, cycle + 11, cycle + 12, cycle + 13, cycle + 14};

  if (cycle % 50 == 0) s.AddEvent({3, 2, static_cast<std::int32_t>(cycle / 50), 1, Value(30, 0, cycle)});
  s.AddFrame(SampleFrame(0x080, cycle), telemetry::Direction::kSent, 10'000);
  s.AddFrame(SampleFrame(0x101, cycle), telemetry::Direction::kReceived, 120'000);
  return s;
}

inline const char* SampleEventText(int code) { return code == 1 ? "one" : "some event"; }

}  // namespace reed::test
