// Forward kinematics and planning of one arm, for the tests of references.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "reed/config/schema/halves.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/firmware/setup/path_planner.h"
#include "reed/tests/support/arms.h"

namespace reed::reference {

/// Forward kinematics of one arm, and a scenario with wide limits.
template <int N>
struct Bench {
  explicit Bench(const ArmDescription& arm) : model(model::ArmModelFrom<N, 12>(NominalOf(arm))) {
    scenario.arm = NominalOf(arm);
    scenario.arm.position_min_rad.assign(N, -3.0);
    scenario.arm.position_max_rad.assign(N, 3.0);
    scenario.arm.speed_limit_radps.assign(N, 10.0);
    scenario.duration_s = 2.0;
  }
  model::Kinematics<N> At(const model::Vec<N>& q) const {
    model::Kinematics<N> kin;
    model::ForwardKinematics<N, 12>(model, q, model::Vec<N>::Zero(), kin);
    return kin;
  }
  PoseOf<N> pose_of() const {
    return [this](const model::Vec<N>& q) { return At(q); };
  }
  PlannedPath<N> Plan(const model::Vec<N>& start, const std::vector<ReferenceLeg>& legs) {
    scenario.reference.start_rad.assign(start.data(), start.data() + N);
    scenario.reference.legs = legs;
    return PathPlanner<N>(pose_of(), scenario).Plan();
  }
  /// The line of a refusal.
  std::string Refusal(const model::Vec<N>& start, const std::vector<ReferenceLeg>& legs) {
    try {
      Plan(start, legs);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  model::ArmModel<N, 12> model;
  ControllerConfig scenario;
};

inline model::Vec<5> PoseA5() { return (model::Vec<5>() << 0.2, 1.0, -1.7, -2.4, 0.3).finished(); }
inline model::Vec<7> PoseA7() {
  return (model::Vec<7>() << 0.2, 0.6, -0.3, -1.4, 0.25, 0.9, -0.4).finished();
}

}  // namespace reed::reference
