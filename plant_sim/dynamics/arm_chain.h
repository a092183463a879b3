// The arm as a chain of joints and bending members, base to tip, with the mass that each carries.
// RT: set-up only.
#pragma once

#include <string>
#include <vector>

#include "reed/config/plant/plant_config.h"
#include "reed/plant/dynamics/beam_elasticity.h"
#include "reed/plant/dynamics/beam_inertia.h"
#include "reed/plant/dynamics/friction.h"
#include "reed/plant/dynamics/joint_spring.h"
#include "reed/plant/dynamics/rigid_body.h"

namespace reed::plant {

/// One element of a straight member.
struct Member {
  double length = 0.0;  // m
  BeamElasticity elasticity;
  BeamInertia inertia;
  double body_at = -1.0;  // m, cross-section that carries `body`; -1: none
  RigidBody body;         // in the section's axes, about its origin
  int link = 0;           // 0-based, the link that it is part of
};

/// One element of the chain: a turn about z of its mount, or a member along x of its mount.
struct Element {
  Placement mount;  // in the output frame of the element before it
  int joint = -1;   // index, or -1
  int member = -1;  // index, or -1
  RigidBody body;   // fixed to the output frame (the turned frame, the member's tip section), in its axes
  bool mount_turns = false, mount_shifts = false;  // whether the mount is more than an identity
};

/// What is between the motor torque and the joint.
struct Drivetrain {
  double rotor_inertia = 0.0;  // kg·m², reflected to the joint
  JointSpring spring;
  JointFriction friction;
  double holding_torque = 0.0;  // N·m, of the brake
};

struct ArmChain {
  std::vector<Element> elements;
  std::vector<Drivetrain> drivetrains;  // one per joint
  std::vector<Member> members;
  Placement tool;                                        // tool point in the last output frame
  Placement force_sensor;                                // its frame in the last output frame
  double sensed_mass = 0.0;                              // kg, of the tool behind the force sensor
  Eigen::Vector3d sensed_com = Eigen::Vector3d::Zero();  // m, in the sensor's frame
  Eigen::Vector3d base = Eigen::Vector3d::Zero();        // m, where the arm begins, world frame
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();     // m/s², world frame

  int dof() const { return static_cast<int>(drivetrains.size()); }
  /// Motor angles, joint angles, elastic coordinates of every member.
  int num_coordinates() const { return 2 * dof() + kElastic * static_cast<int>(members.size()); }
};

/// Throws std::invalid_argument, naming what is missing, when the arm cannot be simulated.
ArmChain BuildChain(const TrueArm& arm, const PlantModelConfig& config);

/// Structural damping proportional to stiffness: d = beta k_q in every joint, beta K in every member.
void SetStructuralDamping(ArmChain& chain, double beta_s);

}  // namespace reed::plant
