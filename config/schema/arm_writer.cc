#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/arm_file.h"
#include "reed/config/schema/writer.h"

namespace reed {
namespace {

template <typename Item, typename Write>
toml::array Tables(const std::vector<Item>& items, Write write) {
  toml::array out;
  for (Item item : items) {
    toml::table table;
    Writer writer(table);
    write(writer, item);
    out.push_back(std::move(table));
  }
  return out;
}

void Parameters(const ArmDescription& arm, toml::table& out) {
  toml::array names, nominal, lo, hi, shapes;
  for (const StructuralParameter& p : arm.parameters) {
    names.push_back(p.name);
    nominal.push_back(p.nominal);
    lo.push_back(p.lo);
    hi.push_back(p.hi);
    for (ParameterShape shape : p.shapes) {
      toml::table item;
      Writer writer(item);
      BodyFields(writer, shape.unit, "inertia_com");
      item.insert("param", p.name);
      item.insert("body", shape.body + 1);
      shapes.push_back(std::move(item));
    }
    if (!p.viscous_weights.empty())
      shapes.push_back(toml::table{{"param", p.name}, {"viscous_weights", ToToml(p.viscous_weights)}});
  }
  out.insert("param_names", std::move(names));
  out.insert("p_nom", std::move(nominal));
  out.insert("p_lo", std::move(lo));
  out.insert("p_hi", std::move(hi));
  out.insert("param_shapes", std::move(shapes));
}

/// A row of four numbers where an angle has an offset.
toml::array DhRows(const std::vector<Joint>& joints) {
  toml::array rows;
  for (const Joint& joint : joints) {
    toml::array row{joint.rpy_rad.x(), joint.xyz_m.x(), joint.d_m};
    if (joint.offset_rad != 0.0) row.push_back(joint.offset_rad);
    rows.push_back(std::move(row));
  }
  return rows;
}

void Geometry(ArmDescription& arm, toml::table& out) {
  toml::table base, tool, sensor;
  Writer base_writer(base), tool_writer(tool), sensor_writer(sensor);
  BaseFields(base_writer, arm.base);
  ToolFields(tool_writer, arm.tool);
  out.insert("base", std::move(base));
  out.insert("tool", std::move(tool));
  Fields(sensor_writer, arm.force_sensor);
  out.insert("force_sensor", std::move(sensor));
  if (arm.IsOfDhRows())
    out.insert("dh", DhRows(arm.joints));
  else
    out.insert("joint", Tables(arm.joints, [](Writer& w, Joint& joint) { Fields(w, joint); }));
}

toml::array Members(const ArmDescription& arm) {
  toml::array out;
  for (FlexibleMember member : arm.members) {
    toml::table item{{"link", member.link + 1}};
    Writer writer(item);
    Fields(writer, member);
    out.push_back(std::move(item));
  }
  return out;
}

toml::table Truth(ArmDescription arm) {
  toml::table out;
  Writer writer(out);
  TruthFields(writer, arm);
  std::vector<double> p;
  for (const StructuralParameter& parameter : arm.parameters) p.push_back(parameter.truth);
  if (!p.empty()) out.insert("p", ToToml(p));
  out.insert("bodies", Tables(arm.bodies, [](Writer& w, InertialBody& body) {
               BodyFields(w, body, "inertia_about_com");
             }));
  return out;
}

}  // namespace

toml::table WriteArm(const ArmDescription& description) {
  ArmDescription arm = description;  // visitors take references; the writer only reads
  toml::table out;
  Writer writer(out);
  ArmFields(writer, arm);
  Geometry(arm, out);
  if (!arm.parameters.empty()) Parameters(arm, out);
  const auto fields = [](Writer& w, auto& item) { Fields(w, item); };
  if (!arm.known.empty()) out.insert("known_bodies", Tables(arm.known, fields));
  if (!arm.sections.empty()) out.insert("sections", Tables(arm.sections, fields));
  if (!arm.members.empty()) out.insert("member", Members(arm));
  if (!arm.bodies.empty()) out.insert("truth", Truth(arm));
  return out;
}

}  // namespace reed
