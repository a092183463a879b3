#include "reed/config/schema/arm_file.h"

#include <cmath>

#include "reed/config/schema/arm_bodies.h"
#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/arm_joints.h"
#include "reed/config/schema/arm_members.h"
#include "reed/config/schema/arm_parameters.h"
#include "reed/config/schema/reader.h"

namespace reed {
namespace {

constexpr double kDefaultRange_rad = 2.9;
constexpr double kDefaultSpeed_radps = 3.0;

/// What guards a run has a careful default; what the drives are made of has none.
void CompleteLimits(Reader& in, ArmDescription& arm) {
  if (arm.position_min_rad.size() != arm.position_max_rad.size())
    in.Fail("position_min", "comes with position_max, for the same joints");
  if (arm.position_min_rad.empty()) arm.position_min_rad.assign(arm.joints.size(), -kDefaultRange_rad);
  if (arm.position_max_rad.empty()) arm.position_max_rad.assign(arm.joints.size(), kDefaultRange_rad);
  if (arm.speed_limit_radps.empty()) arm.speed_limit_radps.assign(arm.joints.size(), kDefaultSpeed_radps);
  for (std::size_t i = 0; i < arm.position_min_rad.size(); ++i)
    if (arm.position_min_rad[i] >= arm.position_max_rad[i])
      in.Fail("position_min", "joint " + std::to_string(i + 1) + ": not below position_max");
}

void CheckGravity(Reader& in, const ArmDescription& arm) {
  const double g = arm.gravity_mps2.norm();
  if (g != 0.0 && (g < 1.5 || g > 30.0))
    in.Fail("gravity",
            "magnitude " + ToText(g) +
                "; allowed: 0, or 1.5 ... 30 m/s² (a vector in m/s² in the world frame, not in units of g)");
}

void CheckToolMass(Reader& in, const ArmDescription& arm) {
  const double link_kg = arm.bodies.back().mass_kg;
  if (arm.force_sensor.tool_mass_kg > link_kg)
    in.Fail("force_sensor", "tool_mass_kg " + ToText(arm.force_sensor.tool_mass_kg) +
                                " kg is a part of the last link, which has " + ToShortText(link_kg) + " kg");
}

/// The truth has a place of its own; files from before it keep it among the other keys.
Reader& PlaceOf(Reader& in, Reader& truth, const char* old_key, const char* key) {
  if (in.Has(old_key) && truth.Has(key))
    in.Fail(old_key, std::string("given twice; it is truth.") + key + " now");
  return in.Has(old_key) ? in : truth;
}

}  // namespace

ArmDescription ReadArm(const Document& doc, toml::table& table, const std::string& section) {
  ArmDescription arm;
  Reader head(doc, &table, section);
  arm.joints = ReadJoints(head);
  Reader in(doc, &table, section, arm.dof());
  const std::string truth_name = head.KeyName("truth");
  Reader truth(doc, SectionOf(head, "truth"), truth_name, arm.dof());
  for (const char* read_over :
       {"units", "convention", "dh", "joint", "dh_rows", "L", "l1", "l2", "lc", "note", "truth"})
    in.Get(read_over);
  ReadKnownBodies(in, arm);
  Reader& bodies = PlaceOf(in, truth, "bodies", "bodies");
  if (bodies.Has("bodies") || arm.known.empty()) ReadBodies(bodies, arm);
  ReadBaseAndTool(in, arm);
  ReadForceSensor(in, arm);
  ArmFields(in, arm);
  CheckGravity(in, arm);
  CompleteLimits(in, arm);
  ReadParameters(in, truth, arm);
  PlaceOf(in, truth, "coulomb", "coulomb");
  in.PerJoint("coulomb", arm.coulomb_Nm, kArmCoulomb, "");
  const bool old_place = in.Has("coulomb");  // there it is declared, too
  if (old_place && arm.coulomb_declared_Nm.empty()) arm.coulomb_declared_Nm = arm.coulomb_Nm;
  TruthFields(truth, arm);
  ReadFlexibleMembers(in, arm);
  CheckToolMass(in, arm);
  in.RefuseUnknown();
  truth.RefuseUnknown();
  return arm;
}

ArmDescription LoadArm(const std::string& name_or_path) {
  Document doc = Document::Load(FindConfig("arms", name_or_path));
  ArmDescription arm = ReadArm(doc, doc.root(), "");
  if (arm.name.empty()) arm.name = doc.stem();
  return arm;
}

}  // namespace reed
