// Strain energy of one straight element (7)-(11), (15), with what the paper leaves out of its plane:
//   E_p2 = 1/2 ∫ (EI_z v''² + EI_y w''²) dl + 1/2 EA u(L)²/L + 1/2 GJ φ(L)²/L      (the text of (18) prints E_p3)
// Bending v, w with dv_axial = -n v' (7) and I = ∫ n² dA (11); axial strain and twist constant along the
// element. Structural damping: the same form in the rates times β. RT: safe after construction.
#pragma once

#include "reed/plant/dynamics/section.h"

namespace reed::plant {

struct BeamElasticity {
  // K = ∂²E_p2/∂e². The shapes make it nearly diagonal: in each plane only tip deflection and tip slope are
  // coupled.
  struct Plane {
    BendingVec diagonal = BendingVec::Zero();  // of EI ∫N''N''ᵀ dl
    double coupling = 0.0;                     // its entry (0, 1)
  };
  Plane v, w;                         // with EI_z, with EI_y
  double axial = 0.0, torsion = 0.0;  // EA/L, GJ/L
  double beta = 0.0;                  // s

  BeamElasticity() = default;
  BeamElasticity(double length, double EI_y, double EI_z, double EA, double GJ);

  ElasticVec Force(const ElasticVec& e) const;  // K e
  double Energy(const ElasticVec& e) const { return 0.5 * e.dot(Force(e)); }
};

}  // namespace reed::plant
