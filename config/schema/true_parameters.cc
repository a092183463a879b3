#include "reed/config/schema/true_parameters.h"

namespace reed {
namespace {

/// Inertia of a point mass about the origin, per mass: |c|² 1 - c cᵀ.
Eigen::Matrix3d Steiner(const Eigen::Vector3d& c) {
  return c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose();
}

/// body + share * unit; about the origin all three moments add.
void Add(InertialBody& body, double share, const InertialBody& unit) {
  const double m = body.mass_kg + share * unit.mass_kg;
  const Eigen::Vector3d h = body.mass_kg * body.com_m + share * unit.mass_kg * unit.com_m;
  const Eigen::Matrix3d J = body.inertia_com_kgm2 + body.mass_kg * Steiner(body.com_m) +
                            share * (unit.inertia_com_kgm2 + unit.mass_kg * Steiner(unit.com_m));
  const Eigen::Vector3d c = m > 0.0 ? Eigen::Vector3d(h / m) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  body = {m, c, J - m * Steiner(c)};
}

}  // namespace

void SetTrueParameters(ArmDescription& arm, const std::vector<double>& p) {
  for (std::size_t k = 0; k < p.size(); ++k) {
    StructuralParameter& parameter = arm.parameters[k];
    const double change = p[k] - parameter.truth;
    if (change == 0.0) continue;  // a written configuration is read back as it is
    for (const ParameterShape& shape : parameter.shapes)
      Add(arm.bodies[static_cast<std::size_t>(shape.body)], change, shape.unit);
    parameter.truth = p[k];
  }
}

}  // namespace reed
