// What the plant's discretisation says about frequencies, statics and shapes, for people: inspect and its
// pictures. Set-up only: it allocates, and throws std::invalid_argument on what cannot be simulated.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "reed/config/plant/plant_config.h"

namespace reed::plant {

/// Bending frequencies in Hz, ascending, of a clamped beam with a point mass at its tip, in one plane.
std::vector<double> BeamModes(double length_m, double EI_Nm2, double rhoA_kgpm, double tip_mass_kg,
                              int elements = PlantModelConfig{}.elements_per_link);

/// The arm with locked motors.
class ArmModes {
 public:
  ArmModes(const TrueArm& arm, const PlantModelConfig& config, const Eigen::VectorXd& motor_angle_rad);
  ~ArmModes();

  /// Equilibrium under a force at the tool point (world frame), with or without gravity. Returns the tool
  /// point.
  Eigen::Vector3d Load(const Eigen::Vector3d& tip_force_N, bool gravity);

  /// Modes at the last equilibrium: frequencies in Hz, ascending.
  const std::vector<double>& frequency_hz() const;

  /// Points of the centre line from base to tool point, world frame: every joint, every member's ends and
  /// `samples` points inside each element. The same points in the same order in the three of them.
  std::vector<Eigen::Vector3d> Undeformed(int samples = 8);
  std::vector<Eigen::Vector3d> Deformed(int samples = 8);
  /// Displacement from the equilibrium in mode `index`, scaled so that the largest one is 1.
  std::vector<Eigen::Vector3d> ModeShape(int index, int samples = 8);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reed::plant
