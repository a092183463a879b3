// Elastic joint between the motor-side angle θ and the link-side angle q, ξ = θ - q.
//   E_p3 = 1/2 k_q ξ² + 1/4 k_3 ξ⁴                      (16), the paper's E_p2 in the text of (18)
//   torque on the link   τ_s = ∂E_p3/∂ξ + d ξ'          structural damping d
// RT: safe.
#pragma once

namespace reed::plant {

struct JointSpring {
  double k_q = 0.0;  // N·m/rad
  double k_3 = 0.0;  // N·m/rad³, 0: linear
  double d = 0.0;    // N·m·s/rad

  double Energy(double xi) const { return (0.5 * k_q + 0.25 * k_3 * xi * xi) * xi * xi; }  // (16)
  double Torque(double xi, double xi_dot) const { return (k_q + k_3 * xi * xi) * xi + d * xi_dot; }
  double TangentStiffness(double xi) const { return k_q + 3.0 * k_3 * xi * xi; }
};

}  // namespace reed::plant
