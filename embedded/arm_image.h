// Every number of an ArmModel in one order, as plain doubles: written on the host, read back by a target that
// has no heap for an ArmDescription. One list of fields for both ways.
#pragma once

#include "reed/core/model/arm_model.h"

namespace reed::embedded {

template <typename Each, int N, int P>
void VisitNumbers(Each&& each, model::ArmModel<N, P>& arm) {
  const auto list = [&](auto& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) each(values.data()[i]);
  };
  const auto index = [&](int& value) {
    double number = value;
    each(number);
    value = static_cast<int>(number);
  };
  list(arm.cos_alpha), list(arm.sin_alpha), list(arm.a), list(arm.d);
  list(arm.gravity), list(arm.tool_offset);
  for (int i = 0; i <= N; ++i) index(arm.first_shape[i]);
  for (int j = 0; j < arm.first_shape[N]; ++j) {
    index(arm.shape[j].k);
    each(arm.shape[j].unit.m), list(arm.shape[j].unit.h), list(arm.shape[j].unit.J);
  }
  list(arm.viscous), list(arm.p_nominal), list(arm.p_lo), list(arm.p_hi);
  index(arm.num_parameters);
  list(arm.rotor_inertia), list(arm.joint_stiffness), list(arm.joint_hardening), list(arm.torque_limit);
  list(arm.position_min), list(arm.position_max), list(arm.speed_limit);
  index(arm.num_members);
  for (int j = 0; j < arm.num_members; ++j) {
    model::Member& member = arm.member[j];
    index(member.link), index(member.axis);
    for (double* value :
         {&member.start_at, &member.end_at, &member.length, &member.EA, &member.EI, &member.GJ, &member.rhoA})
      each(*value);
  }
  for (int i = 0; i < N; ++i) index(arm.carrier[i]);
}

}  // namespace reed::embedded
