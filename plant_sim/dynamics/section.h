// Cross-section of a bent element: where it is, how it is turned, how both change. Axes of the element's base
// frame, l along x; bending v along y and w along z, axial displacement u, twist φ.
//
//   r = (l + u l/L - 1/2 aᵀSa - 1/2 bᵀSb, v, w)       second-order foreshortening, so load along the beam
//   stiffens or
//                                                     softens it (geometric stiffening)
//   Q = Cayley(c) Rot_x(φ), c = (0, -w', v')          exact rotation; its x axis is the tangent r' to second
//   order
// RT: safe after construction.
#pragma once

#include <Eigen/Core>

#include "plant_sim/dynamics/beam_shapes.h"
#include "plant_sim/dynamics/rigid_body.h"

namespace reed::plant {

/// Elastic coordinates of one element: bending a, bending b, axial u(L), twist φ(L).
inline constexpr int kElastic = 2 * kBending + 2;
inline constexpr int kA = 0, kB = kBending, kU = 2 * kBending, kTwist = 2 * kBending + 1;
using ElasticVec = Eigen::Matrix<double, kElastic, 1>;
using ElasticMat = Eigen::Matrix<double, kElastic, kElastic>;

class Section {
 public:
  Section() = default;
  Section(double l, double length);

  /// Takes the element's coordinates and their rates; everything below refers to them.
  void Deform(const ElasticVec& e, const ElasticVec& e_dot);

  /// The section's frame in the base frame of the element.
  const Placement& pose() const { return pose_; }

  /// Motion of the section's frame, in its own axes, carried by a base frame that moves like this.
  Motion CarriedBy(const Motion& base) const;
  Rate CarriedBy(const Rate& base, const Eigen::Ref<const ElasticVec>& e_rate) const;

  /// d(linear, angular)/de, 6 x kElastic, relative to the base and in its axes.
  using Jacobian = Eigen::Matrix<double, 6, kElastic, Eigen::RowMajor>;
  const Jacobian& jacobian() const { return J_; }

 private:
  double l_ = 0.0, share_ = 0.0;  // share_ = l/L
  BendingVec N_, slope_;
  BendingMat S_;
  Placement pose_;
  Jacobian J_;
  Eigen::Vector3d velocity_, omega_, bias_linear_, bias_angular_;
};

}  // namespace reed::plant
