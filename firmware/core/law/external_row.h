// The row of a law from outside, reed/law.h: the same torque whatever is known of the force; what it adapts is its own.
// RT: as safe as that law.
#pragma once

#include "reed/core/law/law.h"

namespace reed::strategy {

template <int N, int P>
struct ExternalRow : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;

  static V Known(const In& in, const State&) noexcept {
    const control::Reference<N>& ref = in.desired;
    const reed_law_input input{
        .joints = N,
        .parameters = in.arm.num_parameters,
        .period_s = in.T,
        .time_s = in.t_s,
        .adapt = in.adapts ? 1 : 0,
        .source = static_cast<std::int32_t>(in.source),
        .theta = in.measured.theta.data(),
        .theta_dot = in.measured.theta_dot.data(),
        .theta_d = ref.theta_d.data(),
        .theta_d_dot = ref.theta_d_dot.data(),
        .theta_d_ddot = ref.theta_d_ddot.data(),
        .v = in.aux.v.data(),
        .v_dot = in.aux.v_dot.data(),
        .s = in.s.data(),
        .Y = in.regressor.Y.data(),
        .f_known = in.regressor.f_known.data(),
        .p_0 = in.gains.p_0.data(),
        .J_m = in.arm.rotor_inertia.data(),
        .Jt_F_d = in.JtF_d.data(),
        .f_n = in.f,
        .r = in.r.data(),
    };
    in.external->step(&input, in.external->state, in.external->output);
    return Eigen::Map<const V>(in.external->output->torque);
  }
  static constexpr auto Unknown = Known;
};

}  // namespace reed::strategy
