#include "reed/config/schema/rigid_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reed/math/turn.h"

namespace reed {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RigidPose PoseOf(const ArmStructure& arm, const std::vector<double>& q_rad) {
  RigidPose pose;
  Matrix3d R = arm.base.rotation();
  Vector3d p = arm.base.xyz_m;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const Joint& joint = arm.joints[i];
    p += R * joint.xyz_m;
    R = R * joint.rotation() * math::TurnZ(q_rad[i]);
    p += R.col(2) * joint.d_m;
    pose.R.push_back(R);
    pose.p.push_back(p);
  }
  pose.tip = p + R * arm.tool.xyz_m;
  return pose;
}

Eigen::Matrix3Xd TipJacobian(const RigidPose& pose) {
  Eigen::Matrix3Xd J(3, std::ssize(pose.p));
  for (std::size_t i = 0; i < pose.p.size(); ++i)
    J.col(static_cast<Eigen::Index>(i)) = pose.R[i].col(2).cross(pose.tip - pose.p[i]);
  return J;
}

std::vector<double> HoldingTorque(const ArmStructure& arm, const std::vector<InertialBody>& bodies,
                                  const RigidPose& pose) {
  std::vector<double> torque;
  for (std::size_t i = 0; i < pose.p.size(); ++i) {
    Vector3d moment = Vector3d::Zero();  // of the weight behind joint i about its origin
    for (std::size_t b = i; b < bodies.size(); ++b) {
      const Vector3d at = pose.p[b] + pose.R[b] * bodies[b].com_m;
      moment += (at - pose.p[i]).cross(bodies[b].mass_kg * arm.gravity_mps2);
    }
    torque.push_back(-pose.R[i].col(2).dot(moment));
  }
  return torque;
}

std::vector<double> InertiaAboutJoints(const std::vector<InertialBody>& bodies, const RigidPose& pose) {
  std::vector<double> inertia;
  for (std::size_t i = 0; i < pose.p.size(); ++i) {
    const Vector3d axis = pose.R[i].col(2);
    double sum = 0.0;
    for (std::size_t b = i; b < bodies.size(); ++b) {
      const Vector3d at = pose.p[b] + pose.R[b] * bodies[b].com_m, turn = pose.R[b].transpose() * axis;
      sum += bodies[b].mass_kg * axis.cross(at - pose.p[i]).squaredNorm() +
             turn.dot(bodies[b].inertia_com_kgm2 * turn);
    }
    inertia.push_back(sum);
  }
  return inertia;
}

std::vector<double> AnglesFor(const ArmStructure& arm, const Vector3d& tip, std::vector<double> q_rad,
                              double margin_rad) {
  constexpr int kMaxIterations = 500;
  constexpr double kTolerance_m = 1e-10, kLongestStep_rad = 0.2, kDamping_m = 1e-2, kStuck_rad = 1e-12,
                   kBend_rad = 1e-3;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const RigidPose pose = PoseOf(arm, q_rad);
    const Vector3d error = tip - pose.tip;
    if (error.norm() < kTolerance_m) return q_rad;
    const Eigen::Matrix3Xd J = TipJacobian(pose);
    // Levenberg-Marquardt: far from the goal a stretched arm must not throw its joints.
    const double damping = std::min(kDamping_m, error.norm());
    Matrix3d JJt = J * J.transpose();
    JJt.diagonal().array() += damping * damping + 1e-12;
    Eigen::VectorXd step = J.transpose() * JJt.ldlt().solve(error);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest < kStuck_rad)  // stretched: bent to whichever side, before a step leads nearer to the base
      for (Eigen::Index i = 0; i < step.size(); ++i) step[i] += i % 2 == 0 ? -kBend_rad : 2.0 * kBend_rad;
    if (longest > kLongestStep_rad) step *= kLongestStep_rad / longest;
    for (std::size_t i = 0; i < q_rad.size(); ++i)
      q_rad[i] = std::clamp(q_rad[i] + step[static_cast<Eigen::Index>(i)],
                            arm.position_min_rad[i] + margin_rad, arm.position_max_rad[i] - margin_rad);
  }
  return {};
}

std::vector<double> StartAnglesFor(const ArmStructure& arm, const Vector3d& tip,
                                   const std::vector<double>& q_rad, double margin_rad) {
  if (!q_rad.empty()) return AnglesFor(arm, tip, q_rad, margin_rad);
  // A stretched arm has no direction to bend in, so every guess is bent: the golden ratio spreads the joints.
  constexpr int kGuesses = 64;
  constexpr double kGolden = 0.6180339887498949, kPi = std::numbers::pi;
  for (int guess = 1; guess <= kGuesses; ++guess) {
    std::vector<double> q;
    for (std::size_t i = 0; i < arm.joints.size(); ++i) {
      const double share = std::fmod(kGolden * static_cast<double>(i + 1) * guess, 1.0) - 0.5;
      const double range = arm.position_max_rad[i] - arm.position_min_rad[i];
      q.push_back(0.5 * (arm.position_min_rad[i] + arm.position_max_rad[i]) + share * std::min(range, kPi));
    }
    if (q = AnglesFor(arm, tip, q, margin_rad); !q.empty()) return q;
  }
  return {};
}

}  // namespace reed
