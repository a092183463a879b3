// A straight piece of a link that bends. Plain data in SI units. RT: set-up only.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reed {

struct FlexibleMember {
  int link = 0;                                      // 0-based, the link that it is a part of
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  // its end on the side of the base, link frame
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();    // its other end, link frame
  Eigen::Vector3d y_axis =
      Eigen::Vector3d::Zero();  // of its section leans that way, link frame; zero: see axes()
  double EA_N = 0.0;
  double EI_y_Nm2 = 0.0, EI_z_Nm2 = 0.0;  // bending about y and about z of its section
  double GJ_Nm2 = 0.0;
  double rhoA_kgpm = 0.0;  // 0: none of the link's mass lies along it

  double length_m() const { return (to_m - from_m).norm(); }

  /// Columns: x along the member, y and z of its section. Where nothing says how y leans: towards the axis of the link
  /// that follows, in the order x, y, z, x, the one along which the member is longest.
  Eigen::Matrix3d axes() const {
    const Eigen::Vector3d x = (to_m - from_m) / length_m();
    Eigen::Vector3d lean = y_axis;
    if (lean.isZero(0.0)) {
      int longest = 0;
      x.cwiseAbs().maxCoeff(&longest);
      lean = Eigen::Vector3d::Unit((longest + 1) % 3);
    }
    const Eigen::Vector3d y = (lean - x.dot(lean) * x).normalized();
    Eigen::Matrix3d axes;
    axes << x, y, x.cross(y);
    return axes;
  }
};

}  // namespace reed
