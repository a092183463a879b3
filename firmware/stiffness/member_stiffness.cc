#include "reed/firmware/stiffness/member_stiffness.h"

#include <Eigen/Geometry>

namespace reed::model {
namespace {

/// Axes of a member, first column along it. The section is round, so any pair of normals will do.
Eigen::Matrix3d MemberAxes(const Eigen::Vector3d& direction) {
  Eigen::Matrix3d axes;
  const Eigen::Vector3d normal = direction.unitOrthogonal();
  axes << direction, normal, direction.cross(normal);
  return axes;
}

}  // namespace

Mat12 MemberStiffness(const Eigen::Vector3d& direction, double L, double EA, double EI, double GJ) {
  Mat12 K = Mat12::Zero();
  const auto couple = [&K](int a, int b, double k) { K(a, b) = K(b, a) = k; };
  const double k12 = 12.0 * EI / (L * L * L), k6 = 6.0 * EI / (L * L), k4 = 4.0 * EI / L, k2 = 2.0 * EI / L;
  for (int end = 0; end < 12; end += 6) {
    const double slope = end == 0 ? k6 : -k6;
    K(end, end) = EA / L;
    K(end + 3, end + 3) = GJ / L;
    K(end + 1, end + 1) = K(end + 2, end + 2) = k12;
    K(end + 4, end + 4) = K(end + 5, end + 5) = k4;
    couple(end + 1, end + 5, slope);   // force along y with rotation about z
    couple(end + 2, end + 4, -slope);  // force along z with rotation about y
  }
  couple(0, 6, -EA / L);
  couple(3, 9, -GJ / L);
  couple(1, 7, -k12);
  couple(2, 8, -k12);
  couple(4, 10, k2);
  couple(5, 11, k2);
  couple(1, 11, k6);
  couple(2, 10, -k6);
  couple(5, 7, -k6);
  couple(4, 8, k6);

  const Eigen::Matrix3d R = MemberAxes(direction);
  Mat12 to_member = Mat12::Zero();
  for (int block = 0; block < 12; block += 3) to_member.block<3, 3>(block, block) = R.transpose();
  return to_member.transpose() * K * to_member;
}

Vec12 EquivalentNodalLoad(const Eigen::Vector3d& direction, double L, const Eigen::Vector3d& Q) {
  const Eigen::Vector3d couple = (L / 12.0) * direction.cross(Q);
  Vec12 load;
  load << 0.5 * Q, couple, 0.5 * Q, -couple;
  return load;
}

}  // namespace reed::model
