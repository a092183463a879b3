#include "reed/firmware/stiffness/member_stiffness.h"

#include <Eigen/Geometry>

namespace reed::model {
namespace {

/// Bending in one plane: v the deflection and r the rotation of the first end, 6 further on those of the other.
/// sign: of the rotation that goes with a positive slope.
void AddPlane(int v, int r, double sign, double EI, double L, Mat12& K) {
  const auto couple = [&K](int a, int b, double k) { K(a, b) = K(b, a) = k; };
  const double k12 = 12.0 * EI / (L * L * L), k6 = sign * 6.0 * EI / (L * L), k4 = 4.0 * EI / L,
               k2 = 2.0 * EI / L;
  K(v, v) = K(v + 6, v + 6) = k12;
  K(r, r) = K(r + 6, r + 6) = k4;
  couple(v, v + 6, -k12);
  couple(r, r + 6, k2);
  couple(v, r, k6);
  couple(v, r + 6, k6);
  couple(v + 6, r, -k6);
  couple(v + 6, r + 6, -k6);
}

}  // namespace

Mat12 MemberStiffness(const Eigen::Matrix3d& axes, double L, const SectionStiffness& section) {
  Mat12 K = Mat12::Zero();
  K(0, 0) = K(6, 6) = section.EA / L;
  K(3, 3) = K(9, 9) = section.GJ / L;
  K(0, 6) = K(6, 0) = -section.EA / L;
  K(3, 9) = K(9, 3) = -section.GJ / L;
  AddPlane(1, 5, 1.0, section.EI_z, L, K);   // force along y with rotation about z
  AddPlane(2, 4, -1.0, section.EI_y, L, K);  // force along z with rotation about y
  Mat12 to_member = Mat12::Zero();
  for (int block = 0; block < 12; block += 3) to_member.block<3, 3>(block, block) = axes.transpose();
  return to_member.transpose() * K * to_member;
}

Mat12 MemberStiffness(const Eigen::Vector3d& direction, double L, double EA, double EI, double GJ) {
  Eigen::Matrix3d axes;
  const Eigen::Vector3d normal = direction.unitOrthogonal();
  axes << direction, normal, direction.cross(normal);
  return MemberStiffness(axes, L, {EA, EI, EI, GJ});
}

Vec12 EquivalentNodalLoad(const Eigen::Vector3d& direction, double L, const Eigen::Vector3d& Q) {
  const Eigen::Vector3d couple = (L / 12.0) * direction.cross(Q);
  Vec12 load;
  load << 0.5 * Q, couple, 0.5 * Q, -couple;
  return load;
}

}  // namespace reed::model
