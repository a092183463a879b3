#include "plant_sim/dynamics/arm_chain.h"

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

namespace reed::plant {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

namespace {

constexpr double kHoldingTorqueOverLimit = 3.0;  // of a brake, over the drive's torque limit
constexpr double kHoldingTorque = 200.0;         // N·m, where the arm file states no torque limit

void Require(bool condition, const ArmDescription& arm, const std::string& what) {
  if (!condition) throw std::invalid_argument("arm " + arm.name + " cannot be simulated: " + what);
}

void CheckSizes(const ArmDescription& arm) {
  const auto n = static_cast<std::size_t>(arm.dof());
  Require(n > 0 && n <= static_cast<std::size_t>(kMaxJoints), arm,
          "it needs 1 to " + std::to_string(kMaxJoints) + " joints");
  Require(arm.bodies.size() == n, arm, "one body per link is needed");
  Require(arm.rotor_inertia_kgm2.size() == n, arm, "rotor inertia of every joint is needed");
  Require(arm.joint_stiffness_Nmprad.size() == n, arm, "stiffness of every joint is needed");
  for (std::size_t i = 0; i < n; ++i) {
    Require(arm.rotor_inertia_kgm2[i] > 0.0, arm,
            "rotor inertia of joint " + std::to_string(i + 1) + " must be positive");
    Require(arm.joint_stiffness_Nmprad[i] > 0.0, arm,
            "stiffness of joint " + std::to_string(i + 1) + " must be positive");
  }
}

double At(const std::vector<double>& values, std::size_t i, double otherwise) {
  return i < values.size() ? values[i] : otherwise;
}

Drivetrain BuildDrivetrain(const ArmDescription& arm, const PlantConfig& config, std::size_t i) {
  const double scale = config.stiffness_scale * config.joint_stiffness_scale;
  Drivetrain drive;
  drive.rotor_inertia = arm.rotor_inertia_kgm2[i];
  drive.spring.k_q = scale * arm.joint_stiffness_Nmprad[i];
  drive.spring.k_3 = scale * At(arm.joint_hardening_Nmprad3, i, 0.0);
  for (const StructuralParameter& p : arm.parameters)
    drive.friction.viscous += p.truth * At(p.viscous_weights, i, 0.0);
  drive.friction.viscous *= config.friction_scale;
  drive.friction.coulomb = config.friction_scale * At(arm.coulomb_Nm, i, 0.0);
  const double limit = At(arm.torque_limit_Nm, i, 0.0);
  drive.holding_torque = limit > 0.0 ? kHoldingTorqueOverLimit * limit : kHoldingTorque;
  return drive;
}

Placement AlongZ(double d) { return {Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, d)}; }

}  // namespace

ArmChain BuildChain(const ArmDescription& arm, const PlantConfig& config) {
  CheckSizes(arm);
  ArmChain chain;
  chain.gravity = arm.gravity_mps2;
  Placement from_output;  // what lies, rigid, between the last output frame and the next row's start
  for (std::size_t i = 0; i < arm.dh.size(); ++i) {
    const DhRow& row = arm.dh[i];
    const Placement turn{AngleAxisd(row.alpha_rad, Vector3d::UnitX()).toRotationMatrix(), Vector3d::Zero()};
    const Placement shift{Eigen::Matrix3d::Identity(), Vector3d(row.a_m, 0.0, 0.0)};
    const Placement output_to_link = AlongZ(row.d_m);

    Element joint;
    joint.mount = from_output * turn * shift;
    joint.body = InParent(output_to_link, RigidBody{arm.bodies[i].mass_kg, arm.bodies[i].com_m,
                                                    arm.bodies[i].inertia_com_kgm2});
    chain.elements.push_back(joint);
    chain.drivetrains.push_back(BuildDrivetrain(arm, config, i));
    from_output = output_to_link;
  }
  chain.tool = from_output * Placement{Eigen::Matrix3d::Identity(), arm.tool_offset_m};
  return chain;
}

}  // namespace reed::plant
