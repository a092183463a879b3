#include "reed/config/schema/arm_file.h"

#include "reed/config/schema/arm_bodies.h"
#include "reed/config/schema/arm_parameters.h"
#include "reed/config/schema/reader.h"

namespace reed {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr Bound kAngle{"rad", -kTwoPi, kTwoPi};  // beyond: degrees
constexpr Bound kGravity{"m/s²", -30.0, 30.0};

constexpr double kDefaultRange_rad = 2.9;
constexpr double kDefaultSpeed_radps = 3.0;

using Numbers = std::vector<double>;

void CheckWithin(Reader& in, const toml::node* where, const std::string& key, double value,
                 const Bound& bound, const char* hint) {
  if (value < bound.lo || value > bound.hi)
    in.document().Fail(where, in.KeyName(key),
                       ToText(value) + " is out of range; allowed: " + ToText(bound) + " (" + hint + ")");
}

std::vector<DhRow> ReadDh(Reader& in) {
  const std::vector<Numbers> rows = ReadRows(in, "dh", 3);
  if (rows.empty()) in.Fail("dh", "missing; one row [alpha_{i-1} rad, a_{i-1} m, d_i m] per joint");
  if (rows.size() > static_cast<std::size_t>(kMaxJoints))
    in.Fail("dh", std::to_string(rows.size()) + " joints; allowed: 1 ... " + std::to_string(kMaxJoints));
  std::vector<DhRow> dh;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string name = "dh[" + std::to_string(i) + "]";
    const toml::node* where = in.Get("dh")->as_array()->get(i);
    CheckWithin(in, where, name, rows[i][0], kAngle, "alpha is in radians");
    CheckWithin(in, where, name, rows[i][1], kLength, "a is in metres");
    CheckWithin(in, where, name, rows[i][2], kLength, "d is in metres");
    dh.push_back({rows[i][0], rows[i][1], rows[i][2]});
  }
  return dh;
}

/// Zero, one or n numbers for n joints.
void PerJoint(Reader& in, const char* key, Numbers& list, const ArmDescription& arm, const Bound& bound) {
  in.Numbers(key, list, bound, "");
  if (list.size() == 1) list.assign(arm.dh.size(), list[0]);
  if (!list.empty() && list.size() != arm.dh.size())
    in.Fail(key, std::to_string(list.size()) + " numbers for " + std::to_string(arm.dh.size()) +
                     " joints; one per joint, or one for all");
}

void ReadJoints(Reader& in, ArmDescription& arm) {
  PerJoint(in, "rotor_inertia_reflected", arm.rotor_inertia_kgm2, arm, {"kg·m²", 1e-6, 100.0});
  PerJoint(in, "joint_stiffness", arm.joint_stiffness_Nmprad, arm, {"N·m/rad", 1.0, 1e9});
  PerJoint(in, "joint_hardening", arm.joint_hardening_Nmprad3, arm, {"N·m/rad³", 0.0, 1e12});
  PerJoint(in, "coulomb", arm.coulomb_Nm, arm, {"N·m", 0.0, 1e3});
  PerJoint(in, "torque_limit", arm.torque_limit_Nm, arm, {"N·m", 1e-3, 1e4});
  PerJoint(in, "position_min", arm.position_min_rad, arm, kAngle);
  PerJoint(in, "position_max", arm.position_max_rad, arm, kAngle);
  PerJoint(in, "speed_limit", arm.speed_limit_radps, arm, {"rad/s", 0.01, 100.0});
  if (arm.position_min_rad.size() != arm.position_max_rad.size())
    in.Fail("position_min", "comes with position_max, for the same joints");
  // What guards a run has a careful default; what the drives are made of has none.
  if (arm.position_min_rad.empty()) arm.position_min_rad.assign(arm.dh.size(), -kDefaultRange_rad);
  if (arm.position_max_rad.empty()) arm.position_max_rad.assign(arm.dh.size(), kDefaultRange_rad);
  if (arm.speed_limit_radps.empty()) arm.speed_limit_radps.assign(arm.dh.size(), kDefaultSpeed_radps);
  for (std::size_t i = 0; i < arm.position_min_rad.size(); ++i)
    if (arm.position_min_rad[i] >= arm.position_max_rad[i])
      in.Fail("position_min", "joint " + std::to_string(i + 1) + ": not below position_max");
}

void ReadSections(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "sections", [&](Reader& item, std::size_t) {
    for (const char* description : {"link", "E", "G", "rho", "A", "I", "J", "od", "t"}) item.Get(description);
    BeamSection section;
    const auto must = [&](const char* key, double& value, const Bound& bound) {
      if (!item.Has(key)) item.Fail(key, std::string("missing; ") + ToText(bound));
      item.Number(key, value, bound, "");
    };
    must("length", section.length_m, {"m", 1e-4, 20.0});
    must("EA", section.EA_N, {"N", 1.0, 1e12});
    must("EI", section.EI_Nm2, {"N·m²", 1e-3, 1e10});
    must("GJ", section.GJ_Nm2, {"N·m²", 1e-3, 1e10});
    must("rhoA", section.rhoA_kgpm, {"kg/m", 1e-6, 1e4});
    arm.sections.push_back(section);
  });
  if (arm.sections.empty()) return;
  Numbers members;  // lengths of the straight members, base to tip
  for (std::size_t i = 0; i < arm.dh.size(); ++i) {
    if (arm.dh[i].d_m != 0.0) members.push_back(std::abs(arm.dh[i].d_m));
    if (i + 1 < arm.dh.size() && arm.dh[i + 1].a_m != 0.0) members.push_back(std::abs(arm.dh[i + 1].a_m));
  }
  if (members.size() != arm.sections.size())
    in.Fail("sections", std::to_string(arm.sections.size()) + " sections for " +
                            std::to_string(members.size()) +
                            " straight members (non-zero d_i, then non-zero a_i, base to tip)");
  for (std::size_t i = 0; i < members.size(); ++i)
    if (std::abs(members[i] - arm.sections[i].length_m) > 1e-6)
      in.Fail("sections[" + std::to_string(i) + "]", "length " + ToText(arm.sections[i].length_m) +
                                                         " m, but the dh row says " + ToText(members[i]) +
                                                         " m");
}

void ReadGravity(Reader& in, ArmDescription& arm) {
  in.Vector("gravity", arm.gravity_mps2, kGravity, "");
  const double g = arm.gravity_mps2.norm();
  if (g != 0.0 && (g < 1.5 || g > 30.0))
    in.Fail("gravity",
            "magnitude " + ToText(g) +
                "; allowed: 0, or 1.5 ... 30 m/s² (a vector in m/s² in the base frame, not in units of g)");
}

}  // namespace

ArmDescription ReadArm(const Document& doc, toml::table& table, const std::string& section) {
  Reader in(doc, &table, section);
  for (const char* description : {"units", "convention", "dh_rows", "L", "l1", "l2", "lc", "note"})
    in.Get(description);
  ArmDescription arm;
  in.Text("name", arm.name, "");
  arm.dh = ReadDh(in);
  ReadGravity(in, arm);
  in.Vector("tool_offset_in_last_frame", arm.tool_offset_m, kLength, "");
  in.Vector("tool_offset", arm.tool_offset_m, kLength, "");
  ReadBodies(in, arm);
  ReadParameters(in, arm);
  ReadJoints(in, arm);
  ReadSections(in, arm);
  in.RefuseUnknown();
  return arm;
}

ArmDescription LoadArm(const std::string& name_or_path) {
  Document doc = Document::Load(FindConfig("arms", name_or_path));
  return ReadArm(doc, doc.root(), "");
}

}  // namespace reed
