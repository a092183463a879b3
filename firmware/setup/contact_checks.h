// Checks of the file for a press that cannot work. Set-up only; throws std::runtime_error with one line.
#pragma once

#include <stdexcept>
#include <string>

#include "reed/config/controller/controller_config.h"
#include "reed/core/contact/normal_direction.h"
#include "reed/core/contact/stretch_guard.h"
#include "reed/core/reference/joint_path.h"
#include "reed/firmware/setup/inverse_kinematics.h"

namespace reed::reference {

inline std::string Rounded(double value, int digits) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 1 + static_cast<std::size_t>(digits));
}

/// A start behind the wall of the file: the wall's force would become the sensor's zero.
template <int N>
void RefuseStartBehindWall(const PoseOf<N>& pose_of, const ControllerConfig& scenario,
                           const JointPath<N>& path) {
  constexpr double kRounding_m = 1e-6;  // a start at the surface is none
  if (!scenario.wall.present) return;
  const Eigen::Vector3d tip = pose_of(path.At(0.0).theta_d).tip;
  const double gap = scenario.wall.normal.normalized().dot(tip - scenario.wall.point_m);
  if (gap >= -kRounding_m) return;
  throw std::runtime_error("reference.start_rad: the tool point starts " + Rounded(-1e3 * gap, 3) +
                           " mm behind the wall of wall.point_m and wall.normal; allowed: in front of it");
}

/// A press along a direction in which the arm can hardly move: nearly stretched, or folded.
template <int N>
void RefusePressNearSingularity(const PoseOf<N>& pose_of, const ControllerConfig& scenario,
                                const JointPath<N>& path) {
  const ForceConfig& force = scenario.force;
  if (force.source == ForceConfig::Source::kNone || !(force.desired_N > 0.0)) return;
  const model::Kinematics<N> kin = pose_of(path.At(force.start_s).theta_d);
  const model::Vec<N> D = control::PureNormalTranslation<N>(kin.J, scenario.wall.normal.normalized()).D;
  const double allowed = strategy::StretchGuard<N>::kHold / scenario.arm.reach_m();
  const double norm = D.norm();
  if (norm > 0.0 && norm < allowed) return;
  throw std::runtime_error("reference: at force.start_s the arm " +
                           (norm > 0.0 ? "moves " + Rounded(norm, 1) + " rad of its joints per metre"
                                       : std::string("cannot move")) +
                           " along wall.normal, it is nearly stretched or folded; allowed: up to " +
                           Rounded(allowed, 1) + " rad/m");
}

}  // namespace reed::reference
