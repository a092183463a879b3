#include <algorithm>

#include "reed/config/schema/arm_file.h"
#include "reed/config/schema/writer.h"

namespace reed {
namespace {

toml::array Rows(const Eigen::Matrix3d& m) {
  toml::array out;
  for (int r = 0; r < 3; ++r) out.push_back(ToToml(Eigen::Vector3d(m.row(r).transpose())));
  return out;
}

toml::table Body(const InertialBody& body, const char* inertia_key) {
  return toml::table{
      {"mass", body.mass_kg}, {"com", ToToml(body.com_m)}, {inertia_key, Rows(body.inertia_com_kgm2)}};
}

void Parameters(const ArmDescription& arm, toml::table& out) {
  toml::array names, truth, nominal, lo, hi, shapes;
  for (const StructuralParameter& p : arm.parameters) {
    names.push_back(p.name);
    truth.push_back(p.truth);
    nominal.push_back(p.nominal);
    lo.push_back(p.lo);
    hi.push_back(p.hi);
    for (const ParameterShape& shape : p.shapes) {
      toml::table item = Body(shape.unit, "inertia_com");
      item.insert("param", p.name);
      item.insert("body", shape.body + 1);
      shapes.push_back(std::move(item));
    }
    if (!p.viscous_weights.empty())
      shapes.push_back(toml::table{{"param", p.name}, {"viscous_weights", ToToml(p.viscous_weights)}});
  }
  out.insert("param_names", std::move(names));
  out.insert("p_true", std::move(truth));
  out.insert("p_nom", std::move(nominal));
  out.insert("p_lo", std::move(lo));
  out.insert("p_hi", std::move(hi));
  out.insert("param_shapes", std::move(shapes));
}

}  // namespace

toml::table WriteArm(const ArmDescription& arm) {
  toml::table out;
  out.insert("name", arm.name);
  toml::array dh;
  for (const DhRow& row : arm.dh) dh.push_back(toml::array{row.alpha_rad, row.a_m, row.d_m});
  out.insert("dh", std::move(dh));
  out.insert("gravity", ToToml(arm.gravity_mps2));
  out.insert("tool_offset", ToToml(arm.tool_offset_m));
  toml::array bodies;
  for (const InertialBody& body : arm.bodies) bodies.push_back(Body(body, "inertia_about_com"));
  out.insert("bodies", std::move(bodies));
  Parameters(arm, out);
  const auto per_joint = [&](const char* key, const std::vector<double>& list) {
    if (!list.empty()) out.insert(key, ToToml(list));
  };
  per_joint("rotor_inertia_reflected", arm.rotor_inertia_kgm2);
  per_joint("joint_stiffness", arm.joint_stiffness_Nmprad);
  per_joint("joint_hardening", arm.joint_hardening_Nmprad3);
  per_joint("coulomb", arm.coulomb_Nm);
  per_joint("torque_limit", arm.torque_limit_Nm);
  per_joint("position_min", arm.position_min_rad);
  per_joint("position_max", arm.position_max_rad);
  per_joint("speed_limit", arm.speed_limit_radps);
  toml::array sections;
  for (const BeamSection& s : arm.sections)
    sections.push_back(toml::table{
        {"length", s.length_m}, {"EA", s.EA_N}, {"EI", s.EI_Nm2}, {"GJ", s.GJ_Nm2}, {"rhoA", s.rhoA_kgpm}});
  if (!sections.empty()) out.insert("sections", std::move(sections));
  return out;
}

}  // namespace reed
