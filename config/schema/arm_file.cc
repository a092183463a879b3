#include "reed/config/schema/arm_file.h"

#include <cmath>

#include "reed/config/schema/arm_bodies.h"
#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/arm_joints.h"
#include "reed/config/schema/arm_parameters.h"
#include "reed/config/schema/reader.h"
#include "reed/config/schema/tube.h"

namespace reed {
namespace {

constexpr double kDefaultRange_rad = 2.9;
constexpr double kDefaultSpeed_radps = 3.0;

using Numbers = std::vector<double>;

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

/// Lengths of the straight members, base to tip.
Numbers MembersOf(const ArmDescription& arm) {
  Numbers members;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    if (arm.joints[i].d_m != 0.0) members.push_back(std::abs(arm.joints[i].d_m));
    if (i + 1 < arm.joints.size() && arm.joints[i + 1].xyz_m.x() != 0.0)
      members.push_back(std::abs(arm.joints[i + 1].xyz_m.x()));
  }
  return members;
}

BeamSection ReadSection(Reader& item) {
  BeamSection section;
  Fields(item, section);
  return section;
}

/// length and tube: what the other keys would say of a round tube.
BeamSection TubeSection(Reader& item) {
  for (const char* of_the_tube : {"EA", "EI", "GJ", "rhoA"})
    if (item.Has(of_the_tube)) item.Fail(of_the_tube, "given twice; tube says it");
  toml::node* node = item.Get("tube");
  if (!node->is_table())
    item.document().Fail(node, item.KeyName("tube"), "expected {outer = m, wall = m, material = text}");
  Reader in(item.document(), node->as_table(), item.KeyName("tube"));
  Tube tube;
  Fields(in, tube);
  in.RefuseUnknown();
  if (2.0 * tube.wall_m > tube.outer_m)
    in.Fail("wall", ToText(tube.wall_m) + " m is more than half of outer = " + ToText(tube.outer_m) +
                        " m; allowed: up to that, which is a rod");
  double length_m = 0.0;
  LengthField(item, length_m);
  return SectionOf(tube, length_m);
}

void ReadSections(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "sections", [&](Reader& item, std::size_t) {
    for (const char* description : {"link", "E", "G", "rho", "A", "I", "J", "od", "t"}) item.Get(description);
    arm.sections.push_back(item.Has("tube") ? TubeSection(item) : ReadSection(item));
  });
  if (arm.sections.empty()) return;
  for (std::size_t i = 0; i < arm.joints.size(); ++i)
    if (!arm.joints[i].xyz_m.tail<2>().isZero(0.0))
      in.Fail("sections", "a member lies along x or z of its link, joint " + std::to_string(i + 1) +
                              " is beside both; allowed: xyz_m = [x, 0, 0], or no sections (rigid links)");
  const Numbers members = MembersOf(arm);
  if (members.size() != arm.sections.size())
    in.Fail("sections", std::to_string(arm.sections.size()) + " sections for " +
                            std::to_string(members.size()) +
                            " straight members (non-zero d_i, then non-zero a_i, base to tip)");
  for (std::size_t i = 0; i < members.size(); ++i)
    if (std::abs(members[i] - arm.sections[i].length_m) > 1e-6)
      in.Fail("sections[" + std::to_string(i) + "]", "length " + ToText(arm.sections[i].length_m) +
                                                         " m, but the joints are " + ToText(members[i]) +
                                                         " m apart");
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
  ReadSections(in, arm);
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
