// Everything one cycle decided, for the limits and for telemetry. RT: safe.
#pragma once

#include "reed/core/contact/force_mode.h"
#include "reed/core/contact/force_source.h"
#include "reed/core/contact/normal_direction.h"
#include "reed/core/estimate/collision.h"
#include "reed/core/law/surface.h"
#include "reed/core/model/arm_model.h"

namespace reed::strategy {

template <int N>
struct Decision {
  control::Reference<N> plan;     // before force loop and deflection compensation
  control::Reference<N> desired;  // after the static deflection (22)
  control::Auxiliary<N> aux;
  control::NormalDirection<N> normal;
  ForceDemand force;
  ForceSource source = ForceSource::kNone;
  model::Vec<N> s = model::Vec<N>::Zero();
  model::Vec<N> tau_law = model::Vec<N>::Zero();
  Eigen::Vector3d tip_plan = Eigen::Vector3d::Zero();
  double f = 0.0;       // normal force as known, N: tared sensor or observer
  model::Wrench felt;   // environment on the tool as the tared sensor has it, at the tool point, world axes
  Collision collision;  // joint -1: none in this cycle
};

}  // namespace reed::strategy
