// The arm as the controller may know it: no true value of anything uncertain. RT: set-up only (it owns heap
// memory).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reed/config/description/arm_structure.h"

namespace reed {

/// What one unit of a parameter adds to one body.
struct ParameterShape {
  int body = 0;  // 0-based link index
  InertialBody unit;
};

/// One uncertain structural parameter p_k of (28): it scales inertial shapes and, or, viscous friction.
struct NominalParameter {
  std::string name;
  double nominal = 0.0;  // start p_0
  double lo = 0.0;       // box of the projection
  double hi = 0.0;
  std::vector<ParameterShape> shapes;
  std::vector<double> viscous_weights;  // N·m·s/rad per unit, one per joint; empty: none
};

/// Moments of a mass about the origin of its link, axes of the link: they add and subtract, centres do not.
struct KnownMass {
  double mass_kg = 0.0;
  Eigen::Vector3d first_kgm = Eigen::Vector3d::Zero();    // ∫ r dm
  Eigen::Matrix3d second_kgm2 = Eigen::Matrix3d::Zero();  // ∫ r rᵀ dm
};

struct NominalArm : ArmStructure {
  std::vector<KnownMass> known;              // of each link, without the share of the parameters
  std::vector<NominalParameter> parameters;  // at most kMaxParameters
  std::vector<double> coulomb_Nm;            // known at the start, per joint; empty: none
  std::vector<double> coulomb_declared_Nm;   // of a data sheet, per joint: bounds the estimate; empty: none

  int num_parameters() const { return static_cast<int>(parameters.size()); }
};

}  // namespace reed
