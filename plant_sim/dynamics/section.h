// Cross-section of a bent element: where it is, how it is turned, how both change. Axes of the element's base
// frame, l along x; bending v along y and w along z, axial displacement u, twist φ.
//
//   r = (l + u l/L - 1/2 aᵀSa - 1/2 bᵀSb, v, w)       foreshortening of second order: geometric stiffening
//   Q = Cayley(c) Rot_x(φ), c = (0, -w', v')          exact rotation, x axis: tangent r' to second order
// RT: safe after construction.
#pragma once

#include <Eigen/Core>

#include "reed/plant/dynamics/beam_shapes.h"
#include "reed/plant/dynamics/rigid_body.h"

namespace reed::plant {

/// Elastic coordinates of one element: bending a, bending b, axial u(L), twist φ(L).
inline constexpr int kElastic = 2 * kBending + 2;
inline constexpr int kA = 0, kB = kBending, kU = 2 * kBending, kTwist = 2 * kBending + 1;
using ElasticVec = Eigen::Matrix<double, kElastic, 1>;

/// The coordinates together with the rate of the base: [e | linear | angular].
inline constexpr int kBlock = kElastic + 6;
inline constexpr int kLinear = kElastic, kAngular = kElastic + 3;
using BlockVec = Eigen::Matrix<double, kBlock, 1>;
using BlockMat = Eigen::Matrix<double, kBlock, kBlock, Eigen::RowMajor>;

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
  Rate CarriedBy(const BlockVec& rate) const;  // of [e | base]

  /// Rate of the section (its origin, axes of the base) from [e' | linear and angular rate of the base].
  using Transfer = Eigen::Matrix<double, 6, kBlock, Eigen::RowMajor>;
  const Transfer& transfer() const { return X_; }

 private:
  double l_ = 0.0, share_ = 0.0;  // share_ = l/L
  BendingVec N_, slope_;
  BendingMat S_;
  Placement pose_;
  Transfer X_;
  Eigen::Vector3d velocity_, omega_, bias_linear_, bias_angular_;
};

}  // namespace reed::plant
