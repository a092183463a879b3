// Section properties of a rectangular bar or box, so that nobody has to compute them by hand. RT: set-up only.
#pragma once

#include <algorithm>

#include "reed/config/schema/tube.h"

namespace reed {

struct Box {
  double width_m = 0.0;   // outer, along y of the section
  double height_m = 0.0;  // outer, along z
  double wall_m = 0.0;    // thickness; 0: solid
  Material material = Material::kAluminium;
};

/// Polar constant of torsion: of a thin-walled tube by Bredt, of a solid bar by Saint-Venant's series as Roark shortens it
/// (0.5 %).
inline double TorsionConstant(const Box& box) {
  if (box.wall_m > 0.0) {
    const double b = box.width_m - box.wall_m, h = box.height_m - box.wall_m;  // centre line of the wall
    return 2.0 * box.wall_m * b * b * h * h / (b + h);
  }
  const double a = std::max(box.width_m, box.height_m), b = std::min(box.width_m, box.height_m), r = b / a;
  return a * b * b * b * (1.0 / 3.0 - 0.21 * r * (1.0 - r * r * r * r / 12.0));
}

/// Sets everything of a member but its place.
inline void SetSection(const Box& box, FlexibleMember& member) {
  const MaterialConstants& m = kMaterials[static_cast<int>(box.material)];
  const double b = box.width_m, h = box.height_m;
  const double hole = box.wall_m > 0.0 ? 1.0 : 0.0, b_i = hole * (b - 2.0 * box.wall_m),
               h_i = hole * (h - 2.0 * box.wall_m);
  const double A = b * h - b_i * h_i;
  member.EA_N = m.E_Pa * A;
  member.EI_y_Nm2 = m.E_Pa * (b * h * h * h - b_i * h_i * h_i * h_i) / 12.0;
  member.EI_z_Nm2 = m.E_Pa * (h * b * b * b - h_i * b_i * b_i * b_i) / 12.0;
  member.GJ_Nm2 = m.G_Pa * TorsionConstant(box);
  member.rhoA_kgpm = m.rho_kgpm3 * A;
}

}  // namespace reed
