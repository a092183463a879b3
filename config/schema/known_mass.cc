#include "reed/config/schema/known_mass.h"

#include <cmath>

namespace reed {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Inertia of a point mass about the origin, per mass: |c|² 1 - c cᵀ.
Matrix3d Steiner(const Vector3d& c) { return c.squaredNorm() * Matrix3d::Identity() - c * c.transpose(); }

KnownMass MomentsOf(const InertialBody& body) {
  return {body.mass_kg, body.mass_kg * body.com_m,
          0.5 * body.inertia_com_kgm2.trace() * Matrix3d::Identity() - body.inertia_com_kgm2 +
              body.mass_kg * body.com_m * body.com_m.transpose()};
}

void Add(KnownMass& sum, double scale, const KnownMass& other) {
  sum.mass_kg += scale * other.mass_kg;
  sum.first_kgm += scale * other.first_kgm;
  sum.second_kgm2 += scale * other.second_kgm2;
}

/// Rounding residue of the subtraction counts as nothing.
KnownMass WithoutResidue(KnownMass rest, const KnownMass& total) {
  constexpr double kResidue = 1e-13;
  const double mass = std::abs(total.mass_kg);
  if (std::abs(rest.mass_kg) <= kResidue * mass) rest.mass_kg = 0.0;
  if (rest.first_kgm.norm() <= kResidue * (total.first_kgm.norm() + mass)) rest.first_kgm.setZero();
  if (rest.second_kgm2.norm() <= kResidue * (total.second_kgm2.norm() + mass)) rest.second_kgm2.setZero();
  return rest;
}

}  // namespace

std::vector<KnownMass> KnownOf(const ArmDescription& arm) {
  std::vector<KnownMass> known;
  for (std::size_t b = 0; b < arm.bodies.size(); ++b) {
    const KnownMass total = MomentsOf(arm.bodies[b]);
    KnownMass rest = total;
    for (const StructuralParameter& parameter : arm.parameters) {
      KnownMass unit;
      for (const ParameterShape& part : parameter.shapes)
        if (part.body == static_cast<int>(b)) Add(unit, 1.0, MomentsOf(part.unit));
      Add(rest, -parameter.truth, unit);
    }
    known.push_back(WithoutResidue(rest, total));
  }
  return known;
}

InertialBody BodyOf(const KnownMass& mass) {
  const double m = mass.mass_kg;
  const Vector3d c = m > 0.0 ? Vector3d(mass.first_kgm / m) : Vector3d(Vector3d::Zero());
  const Matrix3d inertia = mass.second_kgm2.trace() * Matrix3d::Identity() - mass.second_kgm2;
  return {m, c, inertia - m * Steiner(c)};
}

void Add(InertialBody& body, double share, const InertialBody& unit) {
  const double m = body.mass_kg + share * unit.mass_kg;
  const Vector3d h = body.mass_kg * body.com_m + share * unit.mass_kg * unit.com_m;
  const Matrix3d J = body.inertia_com_kgm2 + body.mass_kg * Steiner(body.com_m) +
                     share * (unit.inertia_com_kgm2 + unit.mass_kg * Steiner(unit.com_m));
  const Vector3d c = m > 0.0 ? Vector3d(h / m) : Vector3d(Vector3d::Zero());
  body = {m, c, J - m * Steiner(c)};
}

}  // namespace reed
