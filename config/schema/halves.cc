#include "reed/config/schema/halves.h"

#include "reed/config/schema/known_mass.h"

namespace reed {

NominalArm NominalOf(const ArmDescription& arm, double coulomb_known) {
  NominalArm nominal;
  static_cast<ArmStructure&>(nominal) = arm;
  nominal.known = arm.known.empty() ? KnownOf(arm) : arm.known;
  nominal.parameters.assign(arm.parameters.begin(), arm.parameters.end());
  nominal.coulomb_Nm = arm.coulomb_nominal_Nm;
  if (nominal.coulomb_Nm.empty())
    for (const double torque : arm.coulomb_declared_Nm) nominal.coulomb_Nm.push_back(coulomb_known * torque);
  nominal.coulomb_declared_Nm =
      arm.coulomb_declared_Nm.empty() ? nominal.coulomb_Nm : arm.coulomb_declared_Nm;
  return nominal;
}

TrueArm TrueOf(const ArmDescription& arm) {
  TrueArm truth;
  static_cast<ArmStructure&>(truth) = arm;
  truth.bodies = arm.bodies;
  truth.coulomb_Nm = arm.coulomb_Nm;
  truth.viscous_Nmsprad = arm.viscous_Nmsprad;
  if (!truth.viscous_Nmsprad.empty()) return truth;
  truth.viscous_Nmsprad.assign(arm.joints.size(), 0.0);
  for (const StructuralParameter& parameter : arm.parameters)
    for (std::size_t i = 0; i < parameter.viscous_weights.size(); ++i)
      truth.viscous_Nmsprad[i] += parameter.truth * parameter.viscous_weights[i];
  return truth;
}

ControllerConfig ControllerHalf(const Scenario& s) {
  ControllerConfig half;
  half.name = s.name;
  half.duration_s = s.duration_s;
  half.seed = s.seed;
  half.allow_wire_overload = s.allow_wire_overload;
  half.arm = NominalOf(s.arm, s.control.coulomb_known);
  half.sensors = s.sensors;  // the data sheet of them
  half.wall = {s.wall.present, s.wall.point_m, s.wall.normal};
  half.reference = s.reference;
  half.force = s.force;
  half.control = s.control;
  half.limits = s.limits;
  half.timing = s.timing;
  return half;
}

PlantConfig PlantHalf(const Scenario& s) {
  PlantConfig half{s.seed,        TrueOf(s.arm),         s.plant,  s.drives, s.sensors, s.wall,
                   s.disturbance, s.reference.start_rad, s.timing, s.faults, s.link};
  half.plant.p_true.clear();  // the arm has them
  return half;
}

}  // namespace reed
