// One step of a linearly implicit Runge-Kutta method of order 2 for y = (x, x'):
//   (I - γhA) k1 = f(y)
//   (I - γhA) k2 = f(y + h k1) - 2 k1
//   y+ = y + h (3/2 k1 + 1/2 k2),      γ = 1 - 1/√2
// Order 2 with any A, so A holds only what is stiff: springs, structural damping, friction, contact, brakes.
// L-stable: a mode far above 1/h decays in one step, and the step size excites none. Slow modes lose
// 0.004 (ωh)⁴ per step. With κ = k2 + 2 k1 each stage is one symmetric system of the size of x (derivation:
// docs/flexible_arm.md). RT: safe.
#pragma once

#include "reed/plant/dynamics/equations_of_motion.h"

namespace reed::plant {

class Rosenbrock {
 public:
  explicit Rosenbrock(int size);

  /// From (x, x_dot), to which `equations` is set, to the state after h; leaves `equations` set to that
  /// state. The loads are those at the two ends of the step.
  void Step(EquationsOfMotion& equations, const Load& begin, const Load& end, double h, Eigen::VectorXd& x,
            Eigen::VectorXd& x_dot);

 private:
  Implicit implicit_;
  Eigen::VectorXd a1_, a2_, v1_, v2_, stage_x_, stage_v_;
};

}  // namespace reed::plant
