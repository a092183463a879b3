// (4) for one Euler-Bernoulli member: 12x12 stiffness between its two ends, and what a spread load does to
// them. RT: safe (no allocation), used at set-up only.
#pragma once

#include <Eigen/Core>

#include "reed/core/model/arm_model.h"

namespace reed::model {

using Mat12 = Mat<12, 12>;
using Vec12 = Vec<12>;

struct SectionStiffness {
  double EA = 0.0, EI_y = 0.0, EI_z = 0.0, GJ = 0.0;  // EI_y: bending about y of the section
};

/// Stiffness in world axes; each end has displacement (3) then rotation (3), start before end. axes: columns along the
/// member, y and z of its section.
Mat12 MemberStiffness(const Eigen::Matrix3d& axes, double L, const SectionStiffness& section);

/// The section is round, so any pair of normals will do.
Mat12 MemberStiffness(const Eigen::Vector3d& direction, double L, double EA, double EI, double GJ);

/// Equivalent nodal wrenches of the force Q spread evenly: half at each end, with couples ±(L/12) t × Q.
Vec12 EquivalentNodalLoad(const Eigen::Vector3d& direction, double L, const Eigen::Vector3d& Q);

}  // namespace reed::model
