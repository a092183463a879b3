#include "reed/plant/dynamics/section.h"

#include "reed/plant/dynamics/processor_clones.h"
#include "reed/plant/dynamics/small_products.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Section::Section(double l, double length) : l_(l), share_(l / length) {
  const BeamShapes shapes = ShapesAt(l, length);
  N_ = shapes.N;
  slope_ = shapes.slope;
  S_ = shapes.S;
  X_.setZero();
  X_(0, kU) = share_;
  X_.block<1, kBending>(1, kA) = N_.transpose();
  X_.block<1, kBending>(2, kB) = N_.transpose();
  X_.rightCols<6>().setIdentity();
  Deform(ElasticVec::Zero(), ElasticVec::Zero());
}

REED_CLONES void Section::Deform(const ElasticVec& e, const ElasticVec& e_dot) {
  const BendingVec a = e.segment<kBending>(kA), b = e.segment<kBending>(kB);
  const BendingVec a_dot = e_dot.segment<kBending>(kA), b_dot = e_dot.segment<kBending>(kB);
  const BendingVec Sa = Times(S_, a), Sb = Times(S_, b);

  pose_.p = {l_ + share_ * e[kU] - 0.5 * a.dot(Sa) - 0.5 * b.dot(Sb), N_.dot(a), N_.dot(b)};
  velocity_ = {share_ * e_dot[kU] - Sa.dot(a_dot) - Sb.dot(b_dot), N_.dot(a_dot), N_.dot(b_dot)};
  bias_linear_ = {-a_dot.dot(Times(S_, a_dot)) - b_dot.dot(Times(S_, b_dot)), 0.0, 0.0};

  // Cayley(c) = 1 + g ([c]x + 1/2 [c]x²), angular velocity g (c' + 1/2 c x c'), g = 1/(1 + c²/4).
  const double c2 = -slope_.dot(b), c3 = slope_.dot(a);
  const double c2_dot = -slope_.dot(b_dot), c3_dot = slope_.dot(a_dot);
  const double g = 1.0 / (1.0 + 0.25 * (c2 * c2 + c3 * c3));
  const double g_dot_over_g = -0.5 * g * (c2 * c2_dot + c3 * c3_dot);
  Matrix3d bend;
  bend << 1.0 - 0.5 * g * (c2 * c2 + c3 * c3), -g * c3, g * c2,  //
      g * c3, 1.0 - 0.5 * g * c3 * c3, 0.5 * g * c2 * c3,        //
      -g * c2, 0.5 * g * c2 * c3, 1.0 - 0.5 * g * c2 * c2;
  const Vector3d bend_omega(0.5 * g * (c2 * c3_dot - c3 * c2_dot), g * c2_dot, g * c3_dot);

  // Rot_x(φ) in the same parametrisation: tan(twist angle/2) = φ/2.
  const double phi = share_ * e[kTwist], phi_dot = share_ * e_dot[kTwist];
  const double h = 1.0 / (1.0 + 0.25 * phi * phi);
  const double h_dot = -0.5 * h * h * phi * phi_dot;
  const double cosine = (1.0 - 0.25 * phi * phi) * h, sine = phi * h;
  const Vector3d tangent = bend.col(0);
  pose_.R.col(0) = tangent;
  pose_.R.col(1) = cosine * bend.col(1) + sine * bend.col(2);
  pose_.R.col(2) = cosine * bend.col(2) - sine * bend.col(1);

  omega_ = bend_omega + h * phi_dot * tangent;
  bias_angular_ =
      g_dot_over_g * bend_omega + h * phi_dot * bend_omega.cross(tangent) + h_dot * phi_dot * tangent;

  X_.block<1, kBending>(0, kA) = -Sa.transpose();
  X_.block<1, kBending>(0, kB) = -Sb.transpose();
  X_.block<3, kBending>(3, kA) = Vector3d(0.5 * g * c2, 0.0, g) * slope_.transpose();
  X_.block<3, kBending>(3, kB) = Vector3d(0.5 * g * c3, -g, 0.0) * slope_.transpose();
  X_.block<3, 1>(3, kTwist) = h * share_ * tangent;
  X_.block<3, 3>(0, kAngular) = -Cross(pose_.p);
}

Motion Section::CarriedBy(const Motion& base) const {
  const Vector3d& w = base.omega;
  const Vector3d& r = pose_.p;
  const Vector3d velocity = base.velocity + w.cross(r) + velocity_;
  const Vector3d linear =
      base.bias_linear + base.bias_angular.cross(r) + w.cross(w.cross(r) + 2.0 * velocity_) + bias_linear_;
  const Vector3d angular = base.bias_angular + w.cross(omega_) + bias_angular_;
  const auto Qt = pose_.R.transpose();
  return {Qt * velocity, Qt * (w + omega_), Qt * linear, Qt * angular};
}

Rate Section::CarriedBy(const BlockVec& rate) const {
  const Eigen::Matrix<double, 6, 1> section = X_ * rate;
  const auto Qt = pose_.R.transpose();
  return {Qt * section.head<3>(), Qt * section.tail<3>()};
}

}  // namespace reed::plant
