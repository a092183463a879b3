// Writes scenarios and their halves; the twin of scenario_file.cc.
#include "reed/config/schema/arm_file.h"
#include "reed/config/schema/scenario_fields.h"
#include "reed/config/schema/scenario_file.h"
#include "reed/config/schema/toml_text.h"
#include "reed/config/schema/writer.h"

namespace reed {
namespace {

template <typename Config>
toml::table Table(Config config) {  // visitors take references; the writer only reads
  toml::table table;
  Writer writer(table);
  Fields(writer, config);
  return table;
}

template <typename Item>
toml::array Tables(const std::vector<Item>& items) {
  toml::array out;
  for (const Item& item : items) out.push_back(Table(item));
  return out;
}

toml::table Head(Scenario s) {
  toml::table table;
  Writer writer(table);
  ScenarioFields(writer, s);
  return table;
}

toml::table Reference(const ReferenceConfig& reference) {
  return toml::table{{"start_rad", ToToml(reference.start_rad)}, {"legs", Tables(reference.legs)}};
}

template <typename Half>
void WriteLaw(const Half& half, toml::table& root) {
  root.insert("reference", Reference(half.reference));
  root.insert("force", Table(half.force));
  root.insert("control", Table(half.control));
  root.insert("limits", Table(half.limits));
}

template <typename Half>
void WriteSimulation(const Half& half, toml::table& root) {
  root.insert("plant", Table(half.plant));
  root.insert("drives", Table(half.drives));
  root.insert("sensors", Table(half.sensors));
  root.insert("wall", Table(half.wall));
  root.insert("disturbance", Table(half.disturbance));
  root.insert("link", Table(half.link));
}

}  // namespace

std::string EffectiveToml(const Scenario& scenario) {
  toml::table root;
  root.insert("scenario", Head(scenario));
  root.insert("arm", WriteArm(scenario.arm));
  WriteSimulation(scenario, root);
  WriteLaw(scenario, root);
  root.insert("timing", Table(scenario.timing));
  if (!scenario.faults.empty()) root.insert("fault", Tables(scenario.faults));
  root.insert("checks", Tables(scenario.checks));
  return ToText(root);
}

std::string ToToml(const ControllerConfig& half) {
  Scenario head;
  head.name = half.name;
  head.duration_s = half.duration_s;
  head.seed = half.seed;
  head.allow_wire_overload = half.allow_wire_overload;
  ArmDescription arm;
  static_cast<ArmStructure&>(arm) = half.arm;
  for (const NominalParameter& p : half.arm.parameters)
    arm.parameters.emplace_back(p.name, p.nominal, p.nominal, p.lo, p.hi, p.shapes, p.viscous_weights);
  arm.coulomb_nominal_Nm = half.arm.coulomb_Nm;
  arm.coulomb_declared_Nm = half.arm.coulomb_declared_Nm;
  arm.known = half.arm.known;
  toml::table root;
  root.insert("scenario", Head(head));
  root.insert("arm", WriteArm(arm));
  root.insert("sensors", Table(half.sensors));
  root.insert("wall", Table(half.wall));
  WriteLaw(half, root);
  root.insert("timing", Table(half.timing));
  return ToText(root);
}

std::string ToToml(const PlantConfig& half) {
  Scenario head;
  head.seed = half.seed;
  ArmDescription arm;
  static_cast<ArmStructure&>(arm) = half.arm;
  arm.bodies = half.arm.bodies;
  arm.coulomb_Nm = half.arm.coulomb_Nm;
  arm.viscous_Nmsprad = half.arm.viscous_Nmsprad;
  toml::table root;
  root.insert("scenario", Head(head));
  root.insert("arm", WriteArm(arm));
  WriteSimulation(half, root);
  root.insert("reference", toml::table{{"start_rad", ToToml(half.start_rad)}});
  root.insert("timing", Table(half.timing));
  if (!half.faults.empty()) root.insert("fault", Tables(half.faults));
  return ToText(root);
}

}  // namespace reed
