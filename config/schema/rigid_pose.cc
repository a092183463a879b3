#include "reed/config/schema/rigid_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "reed/math/turn.h"

namespace reed {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RigidPose PoseOf(const ArmStructure& arm, const std::vector<double>& q_rad) {
  RigidPose pose;
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
  for (std::size_t i = 0; i < arm.dh.size(); ++i) {
    const DhRow& row = arm.dh[i];
    p += R.col(0) * row.a_m;
    R = R * math::TurnX(row.alpha_rad) * math::TurnZ(q_rad[i]);
    p += R.col(2) * row.d_m;
    pose.R.push_back(R);
    pose.p.push_back(p);
  }
  pose.tip = p + R * arm.tool_offset_m;
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
  constexpr double kTolerance_m = 1e-10, kLongestStep_rad = 0.2, kDamping_m = 1e-2;
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
    if (longest > kLongestStep_rad) step *= kLongestStep_rad / longest;
    for (std::size_t i = 0; i < q_rad.size(); ++i)
      q_rad[i] = std::clamp(q_rad[i] + step[static_cast<Eigen::Index>(i)],
                            arm.position_min_rad[i] + margin_rad, arm.position_max_rad[i] - margin_rad);
  }
  return {};
}

}  // namespace reed
