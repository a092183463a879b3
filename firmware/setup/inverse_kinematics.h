// Joint angles for a tool point, orientation kept as far as the joints allow: position first, orientation in
// what is left. Set-up only (iterates until converged).
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <stdexcept>
#include <string>

#include "reed/core/model/kinematics.h"
#include "reed/core/model/positive_solver.h"
#include "reed/math/turn.h"

namespace reed::reference {

/// Small rotation vector that takes R to R_goal, world axes.
inline Eigen::Vector3d RotationError(const Eigen::Matrix3d& R_goal, const Eigen::Matrix3d& R) {
  return math::RotationVector(R_goal * R.transpose());
}

/// Where the arm is at these joint angles: J, tip and hand orientation.
template <int N>
using PoseOf = std::function<model::Kinematics<N>(const model::Vec<N>& q)>;

/// A small one. A stretched arm cannot come nearer to its base by any small motion of the joints: it has to be bent, to
/// whichever side, before a step leads there.
template <int N>
model::Vec<N> Bend() {
  constexpr double kBend_rad = 1e-3;
  model::Vec<N> bend;
  for (int i = 0; i < N; ++i) bend[i] = i % 2 == 0 ? -kBend_rad : 2.0 * kBend_rad;
  return bend;
}

/// Moves q to the closest angles whose tool point is at `tip`; throws std::runtime_error when it cannot get
/// there.
template <int N>
model::Vec<N> SolveInverseKinematics(const PoseOf<N>& pose_of, const Eigen::Vector3d& tip,
                                     const Eigen::Matrix3d& R_goal, model::Vec<N> q) {
  constexpr int kMaxIterations = 200;
  constexpr double kPositionTolerance = 1e-13, kReached = 1e-9, kStepTolerance = 1e-12, kDamping = 1e-3,
                   kLongestStep_rad = 0.2;
  Eigen::Vector3d error;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const model::Kinematics<N> kin = pose_of(q);
    error = tip - kin.tip;
    const model::Mat<3, N> J_v = kin.J.template topRows<3>(), J_w = kin.J.template bottomRows<3>();
    Eigen::Matrix3d JJt = J_v * J_v.transpose();
    JJt.diagonal().array() += 1e-12;  // a planar arm cannot leave its plane: that row of J_v is zero
    const math::PositiveSolver<3> position(JJt);
    model::Vec<N> step = J_v.transpose() * position.Solve(error);
    model::Mat<N, N> null_space = model::Mat<N, N>::Identity();
    for (int j = 0; j < N; ++j) null_space.col(j) -= J_v.transpose() * position.Solve(J_v.col(j));
    const model::Mat<3, N> A = J_w * null_space;
    // Damped: directions in which the remaining freedom hardly turns the hand are left alone.
    Eigen::Matrix3d AAt = A * A.transpose();
    AAt.diagonal().array() += kDamping * kDamping;
    const Eigen::Vector3d turn = RotationError(R_goal, kin.R_last()) - J_w * step;
    // Once more through the null space: of the first pass 1e-12 of a turn that cannot be made would leak into
    // the position, divided by the damping.
    step += null_space * (A.transpose() * math::SolvePositive<3>(AAt, turn));
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > kLongestStep_rad) step *= kLongestStep_rad / longest;
    q += step;
    if (longest >= kStepTolerance) continue;
    if (error.norm() < kPositionTolerance) return q;
    if (error.norm() >= kReached) q += Bend<N>();
  }
  if (error.norm() < kReached) return q;
  throw std::runtime_error("the reference leaves the arm's reach at tool point [" + std::to_string(tip.x()) +
                           ", " + std::to_string(tip.y()) + ", " + std::to_string(tip.z()) + "] m");
}

}  // namespace reed::reference
