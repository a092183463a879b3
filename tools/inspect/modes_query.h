// Frequencies and shapes as the plant's discretisation has them. RT: set-up only.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reed/config/schema/halves.h"

namespace reed::inspect {

/// A clamped beam from "length=...,EI=...,rhoA=...[,tip_mass=...][,elements=...]" (m, N·m², kg/m, kg, 1).
struct BeamQuery {
  double length_m = 0.0, EI_Nm2 = 0.0, rhoA_kgpm = 0.0, tip_mass_kg = 0.0;
  double elements = PlantModelConfig{}.elements_per_link;
};

/// Throws CaseError naming the key and what is allowed.
BeamQuery ParseBeam(const std::string& text);

/// {"freq_hz": [...]}: the first `modes` bending frequencies in one plane, as many as the discretisation has.
void WriteBeamModes(std::ostream& out, const BeamQuery& beam, int modes);

/// {"arm", "q", "freq_hz", "undeformed_m", "deformed_m", "nodes_m", "nodes_deformed_m", "mode_shapes"}: the
/// arm at rest under gravity with its motors locked at q (rad); lines are points from base to tool point,
/// nodes the joints, member ends and tool point among them; a shape's largest displacement is 1.
void WriteArmModes(std::ostream& out, const ArmDescription& arm, const std::vector<double>& q, int modes);

}  // namespace reed::inspect
