// The simulated arm: motors, elastic joints, links that bend, gravity, friction, contact.
// Derived from Lagrange's equations (17)-(21) by another route than the controller's recursions; see
// docs/flexible_arm.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "reed/config/plant/plant_config.h"

namespace reed::plant {

/// The true state at one instant, for sensors, telemetry and checks. SI, world frame.
struct Truth {
  double t_s = 0.0;
  Eigen::VectorXd motor_angle_rad, motor_speed_radps, joint_angle_rad;
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero(), tip_velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d contact_force_N =
      Eigen::Vector3d::Zero();  // environment (wall and disturbance) on the robot, at the tool point
  // What the force sensor feels, in its axes, about its origin: of the environment what acts in front of it, and weight and
  // inertia of tool and payload behind it.
  Eigen::Vector3d sensed_force_N = Eigen::Vector3d::Zero(), sensed_moment_Nm = Eigen::Vector3d::Zero();
  double normal_force_N = 0.0;  // of the wall alone
  double gap_m = 1e9;
  double kinetic_J = 0.0, elastic_J = 0.0, potential_J = 0.0;
};

/// Of Reset().
struct NoEquilibrium : std::runtime_error {
  static constexpr const char* kProblem =
      "the simulated arm finds no equilibrium there; its springs or links are too soft for its weight";
  NoEquilibrium() : std::runtime_error(std::string("reference.start_rad: ") + kProblem) {}
};

/// Points of the centre line from base to tool point (centre_line.h), world frame: as they are, and where the same points
/// would be if nothing bent and the joints were at the motor angles.
struct ArmShape {
  std::vector<Eigen::Vector3d> bent, rigid;
};

class ArmPlant {
 public:
  /// Throws std::invalid_argument when the arm cannot be simulated (no rotor inertia, no sections for
  /// flexible links ...).
  explicit ArmPlant(const PlantConfig& config);
  ~ArmPlant();

  /// Puts the arm at rest, in static equilibrium, with the motors held at these angles. t = 0. Throws NoEquilibrium
  /// where there is none.
  void Reset(const Eigen::VectorXd& motor_angle_rad);

  /// Advances by dt with constant motor torques (or closed brakes: motors held by stiff friction), in steps
  /// of at most plant.max_step_s. No heap allocation after the constructor and one Reset.
  void Advance(const Eigen::VectorXd& motor_torque_Nm, bool braked, double dt_s);

  /// Brakes that are stuck, a bit per motor: from the next Advance on these stay closed or open whatever `braked` says.
  void ForceBrakes(std::uint32_t closed, std::uint32_t open);

  /// From now on the scenario's payload and step of force count; before that neither comes.
  void StartSchedule();

  const Truth& truth() const;
  /// Of this instant; valid until the next call.
  const ArmShape& Shape();
  /// False once a state is not finite or absurd; the caller brakes, says which state and when, and exits 3.
  bool healthy() const;
  std::string fault_description() const;  // names the state and the time, "" while healthy
  int num_coordinates() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reed::plant
