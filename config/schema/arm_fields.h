// The schema of an arm file: keys of the arm, of its truth, of bodies, shapes and sections, each once, with unit,
// bound and meaning. Reader, writer and lister all walk this, as they walk scenario_fields.h. A new parameter of
// the arm is a member of its struct, a line here, and whoever uses it.
#pragma once

#include "reed/config/schema/arm_description.h"
#include "reed/config/schema/bound.h"
#include "reed/config/schema/box.h"
#include "reed/config/schema/tube.h"

namespace reed {

inline constexpr Bound kArmLength{"m", -10.0, 10.0};  // beyond: millimetres
inline constexpr Bound kArmAngle{"rad", -6.3, 6.3};   // two turns, as people round them; beyond: degrees
inline constexpr Bound kArmMass{"kg", 0.0, 500.0};
inline constexpr Bound kArmMoment{"kg·m²", -500.0, 500.0};
inline constexpr Bound kArmCoulomb{"N·m", 0.0, 1e3};
inline constexpr Bound kArmParameter{"unit of the parameter", -1e3, 1e3};

template <typename V>
void FrameFields(V& v, FixedFrame& c, const char* xyz_doc, const char* rpy_doc) {
  v.Vector("xyz_m", c.xyz_m, kArmLength, xyz_doc);
  v.Vector("rpy_rad", c.rpy_rad, kArmAngle, rpy_doc);
}

template <typename V>
void BaseFields(V& v, FixedFrame& c) {
  FrameFields(v, c, "where the arm's base frame lies in the world frame",
              "how it is turned there, as in a URDF: about the fixed x, y and z axes; gravity, wall and "
              "references keep the world's axes");
}

template <typename V>
void ToolFields(V& v, FixedFrame& c) {
  FrameFields(v, c,
              "tool point in the last link's frame (tool_offset and tool_offset_in_last_frame are read too)",
              "how the tool's frame is turned there");
}

template <typename V>
void Fields(V& v, ForceSensor& c) {
  FrameFields(
      v, c, "origin of the force sensor's frame in the last link's frame; absent: tool.xyz_m",
      "how its axes are turned there: forces and moments on the bus are in them; absent: tool.rpy_rad");
  v.Number("tool_mass_kg", c.tool_mass_kg, {"kg", 0.0, 100.0},
           "of the tool behind the sensor, a part of the last link: its weight is taken off the reading");
  v.Vector("tool_com_m", c.tool_com_m, kArmLength, "its centre of mass, sensor's frame");
}

template <typename V>
void Fields(V& v, Joint& c) {
  v.Text("name", c.name, "of the joint");
  v.Text("frame", c.frame, "name of the frame of the link that it moves; absent: link_1, link_2 ...");
  FrameFields(
      v, c, "where the joint lies in the frame of the link before it (of the base for the first), at angle 0",
      "how its frame is turned there, as in a URDF; the joint turns about z of this frame");
}

/// What one may know of it, but for its joints, bodies and parameters.
template <typename V>
void ArmFields(V& v, ArmDescription& c) {
  v.Text("name", c.name, "of the arm; absent: the file's name");
  v.Vector("gravity", c.gravity_mps2, {"m/s²", -30.0, 30.0},
           "world frame, magnitude 0 or 1.5 ... 30 m/s²: a vector in m/s² and not in units of g");
  v.PerJoint("rotor_inertia_reflected", c.rotor_inertia_kgm2, {"kg·m²", 1e-6, 100.0},
             "J_m, motor inertia seen at the joint; needed for a run");
  v.PerJoint("joint_stiffness", c.joint_stiffness_Nmprad, {"N·m/rad", 1.0, 1e9}, "k_q; needed for a run");
  v.PerJoint("joint_hardening", c.joint_hardening_Nmprad3, {"N·m/rad³", 0.0, 1e12},
             "k_3 of the joint spring, torque = k_q ξ + k_3 ξ³");
  v.PerJoint("torque_limit", c.torque_limit_Nm, {"N·m", 1e-3, 1e4}, "symmetric; needed for a run");
  v.PerJoint("position_min", c.position_min_rad, kArmAngle, "below position_max; absent: -2.9");
  v.PerJoint("position_max", c.position_max_rad, kArmAngle, "absent: 2.9");
  v.PerJoint("speed_limit", c.speed_limit_radps, {"rad/s", 0.01, 100.0}, "absent: 3");
  v.PerJoint(
      "coulomb_nominal", c.coulomb_nominal_Nm, kArmCoulomb,
      "Coulomb friction that the controller starts from; absent: control.coulomb_known of coulomb_declared");
  v.PerJoint(
      "coulomb_declared", c.coulomb_declared_Nm, kArmCoulomb,
      "Coulomb friction of the data sheet: the estimate may reach 1.5 times it, or 5 % of torque_limit; "
      "absent: what the controller starts from");
}

/// [truth] of the simulated arm, but for its parameters and bodies.
template <typename V>
void TruthFields(V& v, ArmDescription& c) {
  v.PerJoint("coulomb", c.coulomb_Nm, kArmCoulomb, "Coulomb friction, motor side");
  v.PerJoint("viscous", c.viscous_Nmsprad, {"N·m·s/rad", 0.0, 1e4},
             "viscous friction; absent: what the parameters say");
}

template <typename V>
void BodyFields(V& v, InertialBody& c, const char* inertia_key) {
  v.Required("mass", c.mass_kg, kArmMass, "of the link");
  v.Vector("com", c.com_m, kArmLength, "centre of mass, link frame");
  v.Matrix(
      inertia_key, c.inertia_com_kgm2, kArmMoment,
      "about that centre of mass, axes of the link frame; symmetric, no negative principal moment, triangle "
      "inequality (a first link without mass may have I_zz alone)");
}

template <typename V>
void Fields(V& v, KnownMass& c) {
  v.Required("mass", c.mass_kg, {"kg", -500.0, 500.0}, "∫ dm");
  v.Vector("first_moment", c.first_kgm, {"kg·m", -500.0, 500.0}, "∫ r dm, link frame");
  v.Matrix("second_moment", c.second_kgm2, kArmMoment, "∫ r rᵀ dm, link frame");
}

template <typename V>
void LengthField(V& v, double& length_m) {
  v.Required("length", length_m, {"m", 1e-4, 20.0},
             "of a straight member; one section per non-zero d_i and then non-zero a_i (x of xyz_m of the "
             "next joint), "
             "base to tip, with just that length");
}

template <typename V>
void Fields(V& v, BeamSection& c) {
  LengthField(v, c.length_m);
  v.Required("EA", c.EA_N, {"N", 1.0, 1e12}, "axial stiffness");
  v.Required("EI", c.EI_Nm2, {"N·m²", 1e-3, 1e10}, "bending stiffness, both planes");
  v.Required("GJ", c.GJ_Nm2, {"N·m²", 1e-3, 1e10}, "torsional stiffness");
  v.Required("rhoA", c.rhoA_kgpm, {"kg/m", 1e-6, 1e4}, "mass per length");
}

inline constexpr double kShortestMember_m = 1e-4;

template <typename V>
void MemberPlace(V& v, FlexibleMember& c) {
  v.Vector("from_m", c.from_m, kArmLength,
           "its end on the side of the base, link frame; what is between it and the member before is rigid");
  v.Vector("to_m", c.to_m, kArmLength, "its other end, link frame");
  v.Vector("y_axis", c.y_axis, {"1", -1e3, 1e3},
           "y of its section leans that way, link frame; zero: towards the axis that follows, x to y to z to "
           "x, the one "
           "along which the member is longest");
}

template <typename V>
void MemberStiffnesses(V& v, FlexibleMember& c) {
  v.Required("EA", c.EA_N, {"N", 1.0, 1e12}, "axial stiffness; tube or box say it too");
  v.Required("EI_y", c.EI_y_Nm2, {"N·m²", 1e-3, 1e10},
             "stiffness of bending about y of its section, which moves it along z");
  v.Required("EI_z", c.EI_z_Nm2, {"N·m²", 1e-3, 1e10}, "the same about z");
  v.Required("GJ", c.GJ_Nm2, {"N·m²", 1e-3, 1e10}, "torsional stiffness");
}

template <typename V>
void MemberMass(V& v, FlexibleMember& c) {
  v.Number("rhoA", c.rhoA_kgpm, {"kg/m", 0.0, 1e4},
           "mass per length: in this proportion the link's mass lies along its members; 0: none along this "
           "one; absent: that "
           "of tube or box");
}

template <typename V>
void Fields(V& v, FlexibleMember& c) {
  MemberPlace(v, c);
  MemberStiffnesses(v, c);
  MemberMass(v, c);
}

template <typename V>
void Fields(V& v, Box& c) {
  v.Required("width", c.width_m, {"m", 1e-3, 2.0},
             "outer, along y of the section; box instead of EA, EI_y, EI_z, GJ and rhoA");
  v.Required("height", c.height_m, {"m", 1e-3, 2.0}, "outer, along z of the section");
  v.Number("wall", c.wall_m, {"m", 0.0, 1.0}, "thickness of the wall, thin for its GJ; 0: a solid bar");
  v.Choice("material", c.material, kMaterialNames, "with the constants in config/schema/tube.h");
}

template <typename V>
void Fields(V& v, Tube& c) {
  v.Required("outer", c.outer_m, {"m", 1e-3, 2.0}, "outer diameter; tube instead of EA, EI, GJ and rhoA");
  v.Required("wall", c.wall_m, {"m", 1e-4, 1.0}, "thickness of the wall; half of outer is a rod");
  v.Choice("material", c.material, kMaterialNames, "with the constants in config/schema/tube.h");
}

}  // namespace reed
