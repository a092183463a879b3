// Static equilibrium with the motors held, and the vibration modes about it. Set-up only: it allocates.
#pragma once

#include "reed/plant/dynamics/equations_of_motion.h"

namespace reed::plant {

/// Newton's method on joint angles and elastic coordinates; the motor angles of x stay. The wall and
/// `tip_force_N` (world frame, at the tool point) take part. Leaves `equations` at rest in x. Returns false
/// when it does not converge.
bool Settle(EquationsOfMotion& equations, const Eigen::Vector3d& tip_force_N, Eigen::VectorXd& x);

struct VibrationModes {
  Eigen::VectorXd frequency_hz;  // ascending
  Eigen::MatrixXd shape;         // one column of coordinates per mode, motors at rest, shapeᵀ M shape = 1
};

/// Undamped modes K φ = ω² M φ at the state of `equations`, motors locked, no contact, gravity's own
/// stiffness left out.
VibrationModes LockedMotorModes(const EquationsOfMotion& equations);

}  // namespace reed::plant
