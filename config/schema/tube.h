// Section properties of a round tube, so that nobody has to compute them by hand. RT: set-up only.
#pragma once

#include <numbers>

#include "reed/config/schema/arm_description.h"

namespace reed {

enum class Material { kAluminium, kSteel, kTitanium, kCarbon };
inline constexpr const char* kMaterialNames[] = {"aluminium", "steel", "titanium", "carbon"};

struct MaterialConstants {
  double E_Pa, G_Pa, rho_kgpm3;
};

/// Handbook values: EN AW-6061, structural steel, Ti-6Al-4V; carbon: a quasi-isotropic laminate in epoxy.
inline constexpr MaterialConstants kMaterials[] = {
    {70.0e9, 26.3e9, 2700.0}, {210.0e9, 80.8e9, 7850.0}, {113.8e9, 44.0e9, 4430.0}, {50.0e9, 19.0e9, 1600.0}};

struct Tube {
  double outer_m = 0.0;  // diameter
  double wall_m = 0.0;   // thickness; half of outer_m: a rod
  Material material = Material::kAluminium;
};

constexpr BeamSection SectionOf(const Tube& tube, double length_m) {
  constexpr double kPi = std::numbers::pi;
  const MaterialConstants& m = kMaterials[static_cast<int>(tube.material)];
  const double D = tube.outer_m, d = D - 2.0 * tube.wall_m;
  const double A = kPi / 4.0 * (D * D - d * d);
  const double I = kPi / 64.0 * (D * D * D * D - d * d * d * d);
  return {length_m, m.E_Pa * A, m.E_Pa * I, m.G_Pa * 2.0 * I, m.rho_kgpm3 * A};
}

}  // namespace reed
