// The arm as a chain of joints, base to tip, with the rigid bodies that its frames carry. RT: set-up only.
#pragma once

#include <vector>

#include "config/schema/scenario.h"
#include "plant_sim/dynamics/friction.h"
#include "plant_sim/dynamics/joint_spring.h"
#include "plant_sim/dynamics/rigid_body.h"

namespace reed::plant {

/// One joint: its frame before rotation in the output frame of the element before it, then a turn about its
/// z.
struct Element {
  Placement mount;
  RigidBody body;  // fixed to the output frame, in its axes
};

/// What stands between the motor torque and the joint.
struct Drivetrain {
  double rotor_inertia = 0.0;  // kg·m², reflected to the joint
  JointSpring spring;
  JointFriction friction;
  double holding_torque = 0.0;  // N·m, of the brake
};

struct ArmChain {
  std::vector<Element> elements;
  std::vector<Drivetrain> drivetrains;  // one per joint
  Placement tool;                       // tool point in the last output frame
  Eigen::Vector3d gravity;              // m/s², base frame

  int dof() const { return static_cast<int>(drivetrains.size()); }
};

/// Throws std::invalid_argument, naming what is missing, when the arm cannot be simulated.
ArmChain BuildChain(const ArmDescription& arm, const PlantConfig& config);

}  // namespace reed::plant
