#include "reed/plant/dynamics/equilibrium.h"

#include <cmath>
#include <numbers>

#include "reed/plant/dynamics/symmetric_eigen.h"

namespace reed::plant {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool Settle(EquationsOfMotion& equations, const Eigen::Vector3d& tip_force_N, VectorXd& x) {
  constexpr int kMaxIterations = 100;
  constexpr double kTolerance = 1e-13;  // rad and m
  const VectorXd rest = VectorXd::Zero(x.size());
  Load load;
  load.motor_torque = VectorXd::Zero(equations.dof());
  load.hold_motors = true;
  load.disturbance = tip_force_N;
  Implicit newton;
  newton.y_d = newton.y_k = rest;
  newton.c_k = 1e6;  // leaves nothing else to see: (M + c K) k = F gives c k = K⁻¹ F
  VectorXd step = rest;
  for (int i = 0; i < kMaxIterations; ++i) {
    equations.SetState(x, rest);
    equations.Solve(load, newton, step);
    step *= newton.c_k;
    x += step;
    if (!(step.norm() < 1e3)) return false;
    if (step.norm() < kTolerance) break;
    if (i + 1 == kMaxIterations) return false;
  }
  equations.SetState(x, rest);
  return true;
}

VibrationModes LockedMotorModes(const EquationsOfMotion& equations) {
  const int n = equations.dof(), free = equations.size() - n;
  // M φ = (1/ω²) K φ: K is positive definite, M need not be (a link without mass).
  const MatrixXd M = equations.MassMatrix().bottomRightCorner(free, free);
  const MatrixXd K = equations.StiffnessMatrix().bottomRightCorner(free, free);
  const auto [inverse_square, vectors] =
      GeneralizedEigen(M, K, Wanted::kPairs);  // the lowest frequency comes last

  constexpr double kMassless = 1e-14;  // relative: such a coordinate has no frequency
  int count = 0;
  while (count < free && inverse_square[free - 1 - count] > kMassless * inverse_square[free - 1]) ++count;
  VibrationModes modes;
  modes.frequency_hz.resize(count);
  modes.shape = MatrixXd::Zero(equations.size(), count);
  for (int i = 0; i < count; ++i) {
    const double omega = 1.0 / std::sqrt(inverse_square[free - 1 - i]);
    modes.frequency_hz[i] = omega / (2.0 * std::numbers::pi);
    // The solver's vectors have φᵀKφ = 1, and φᵀMφ = 1/ω².
    modes.shape.col(i).tail(free) = omega * vectors.col(free - 1 - i);
  }
  return modes;
}

}  // namespace reed::plant
