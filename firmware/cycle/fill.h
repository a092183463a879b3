// From the loop's own types to the plain bytes of a snapshot. One field, one line. RT: safe.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "reed/bus/codec/messages.h"
#include "reed/bus/transport/transport.h"
#include "reed/core/controller.h"
#include "reed/core/measurement.h"
#include "reed/firmware/snapshot/snapshot.h"

namespace reed::telemetry {

template <typename Derived, std::size_t K>
void Fill(std::array<double, K>& to, const Eigen::MatrixBase<Derived>& from) noexcept {
  for (Eigen::Index i = 0; i < from.size() && i < static_cast<Eigen::Index>(K); ++i)
    to[static_cast<std::size_t>(i)] = from(i);
}

inline void FillEvents(const EventList& events, Snapshot& out) noexcept {
  for (const reed::Event& from : events) {
    Event to;
    to.mode = static_cast<std::int8_t>(from.mode);
    to.force_source = static_cast<std::int8_t>(from.source);
    to.code = static_cast<std::int32_t>(from.code);
    to.joint = from.joint;
    to.value = from.value;
    out.AddEvent(to);
  }
}

template <int N>
void FillMeasured(const Measurement<N>& m, Measured& out) noexcept {
  Fill(out.position, m.theta);
  Fill(out.velocity, m.theta_dot);
  Fill(out.torque, m.torque);
  for (std::size_t i = 0; i < static_cast<std::size_t>(N); ++i) {
    out.age[i] = m.age[i];
    out.drive_state[i] = static_cast<std::int8_t>(m.drive[i]);
  }
  Fill(out.force, m.force);
  Fill(out.moment, m.moment);
  out.wrench_age = m.wrench_age;
}

template <int N, int P>
void FillControl(const Controller<N, P>& controller, Control& out) noexcept {
  const strategy::Decision<N>& d = controller.decision();
  const strategy::Separated<N, P>& strategy = controller.strategy();
  out.t_s = controller.time_s();
  out.mode = static_cast<std::int8_t>(controller.mode());
  out.limits = controller.limits();
  out.force_source = static_cast<std::int8_t>(d.source);
  Fill(out.theta_plan, d.plan.theta_d);
  Fill(out.theta_d, d.desired.theta_d);
  Fill(out.theta_d_dot, d.desired.theta_d_dot);
  Fill(out.e, d.aux.e);
  Fill(out.s, d.s);
  Fill(out.v, d.aux.v);
  Fill(out.v_dot, d.aux.v_dot);
  Fill(out.tau_law, d.tau_law);
  Fill(out.tau, controller.command().torque);
  Fill(out.D, d.normal.D);
  Fill(out.normal, strategy.normal());
  out.f_d = d.force.f_d;
  out.f = d.f;
  out.e_f = d.force.e_f;
  out.e_f_integral = strategy.force_state().e_f_integral;
  out.z = d.force.z;
  out.k_hat_e = strategy.wall_stiffness();
  Fill(out.tip_plan, d.tip_plan);
  Fill(out.observer, strategy.observed());
}

template <int N, int P>
void FillAdaptation(const strategy::AdaptiveState<N, P>& state, Adaptation& out) noexcept {
  Fill(out.p_hat, state.p_hat);
  Fill(out.eta_hat, state.eta_hat);
  out.sigma0 = state.sigma_0;
  out.sigma1 = state.sigma_1;
}

inline void FillBus(const bus::TransportCounters& t, const bus::DecodeCounters& d, std::int64_t late,
                    BusCounters& out) noexcept {
  const auto rejected = [&](bus::Reject reason) {
    return static_cast<std::int64_t>(d.rejected[static_cast<std::size_t>(reason)]);
  };
  out.frames_rx = static_cast<std::int64_t>(t.frames_rx);
  out.frames_tx = static_cast<std::int64_t>(t.frames_tx);
  out.lost = static_cast<std::int64_t>(d.lost);
  out.crc_errors = rejected(bus::Reject::kCrc);
  out.repeated = rejected(bus::Reject::kRepeated);
  out.wrong_sequence = rejected(bus::Reject::kSequence);
  out.wrong_length = rejected(bus::Reject::kLength);
  out.out_of_range = rejected(bus::Reject::kRange);
  out.unknown_id = rejected(bus::Reject::kUnknownId) + static_cast<std::int64_t>(t.foreign_ids);
  out.malformed = static_cast<std::int64_t>(t.malformed);
  out.error_frames = static_cast<std::int64_t>(t.error_frames);
  out.overflowed = static_cast<std::int64_t>(t.overflowed);
  out.tx_refused = static_cast<std::int64_t>(t.tx_refused);
  out.late = late;
}

}  // namespace reed::telemetry
