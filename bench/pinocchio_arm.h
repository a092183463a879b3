// An arm of config/arms as a Pinocchio model, and its structural parameters in Pinocchio's inertial
// parameters. Set-up only.
#pragma once

#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/multibody.hpp>

#include "reed/config/schema/arm_description.h"

namespace reed::bench {

inline pinocchio::Inertia BodyInertia(const InertialBody& body) {
  return {body.mass_kg, body.com_m, body.inertia_com_kgm2};
}

/// Joint i sits at the fixed transform of the one before, its link's frame d further along z, about which it turns.
inline pinocchio::Model PinocchioModel(const ArmDescription& arm) {
  pinocchio::Model model;
  model.gravity.linear(arm.gravity_mps2);
  pinocchio::JointIndex parent = 0;
  pinocchio::SE3 before(arm.base.rotation(),
                        arm.base.xyz_m);  // of the first joint; the others follow each other
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const Eigen::Matrix3d R = arm.joints[i].rotation();
    const Eigen::Vector3d p = arm.joints[i].xyz_m + R.col(2) * arm.joints[i].d_m;
    const pinocchio::SE3 mount = before * pinocchio::SE3(R, p);
    before = pinocchio::SE3::Identity();
    parent = model.addJoint(parent, pinocchio::JointModelRZ(), mount, "j" + std::to_string(i));
    model.appendBodyToJoint(parent, BodyInertia(arm.bodies[i]), pinocchio::SE3::Identity());
  }
  return model;
}

/// 10N x P: column k holds the inertial parameters that one unit of parameter k adds.
inline Eigen::MatrixXd ParameterMap(const ArmDescription& arm) {
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(10 * arm.dof(), arm.num_parameters());
  for (int k = 0; k < arm.num_parameters(); ++k) {
    for (const ParameterShape& shape : arm.parameters[static_cast<std::size_t>(k)].shapes)
      map.block<10, 1>(10 * shape.body, k) += BodyInertia(shape.unit).toDynamicParameters();
  }
  return map;
}

}  // namespace reed::bench
