// The third visitor: lists every key for config/README.md, so the page cannot drift from the reader.
#include <sstream>

#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/scenario_fields.h"
#include "reed/config/schema/scenario_file.h"

namespace reed {
namespace {

constexpr const char* kHead = "| key | allowed | default | meaning |\n|---|---|---|---|\n";

class Lister {
 public:
  Lister(std::ostringstream& out, std::string section) : out_(out), section_(std::move(section)) {}

  void Number(const char* key, double value, Bound bound, const char* doc) {
    Row(key, ToText(bound), ToText(value), doc);
  }
  void Integer(const char* key, std::int64_t value, Bound bound, const char* doc) {
    Row(key, ToText(bound), std::to_string(value), doc);
  }
  void Seed(const char* key, std::int64_t value, const char* doc) {
    Row(key, "whole number >= 0", std::to_string(value), doc);
  }
  void Boolean(const char* key, bool value, const char* doc) {
    Row(key, "true, false", value ? "true" : "false", doc);
  }
  void Text(const char* key, const std::string& value, const char* doc) { Row(key, "text", value, doc); }
  void Vector(const char* key, const Eigen::Vector3d& v, Bound bound, const char* doc) {
    Row(key, "[x, y, z], each " + ToText(bound),
        "[" + ToText(v.x()) + ", " + ToText(v.y()) + ", " + ToText(v.z()) + "]", doc);
  }
  void Numbers(const char* key, const std::vector<double>&, Bound bound, const char* doc) {
    Row(key, "list, each " + ToText(bound), "", doc);
  }
  void Rows(const char* key, const std::vector<std::vector<double>>&, Bound bound, const char* doc) {
    Row(key, "list of rows, each number " + ToText(bound), "", doc);
  }
  void Required(const char* key, double, Bound bound, const char* doc) {
    Row(key, ToText(bound), "needed", doc);
  }
  void PerJoint(const char* key, const std::vector<double>&, Bound bound, const char* doc) {
    Row(key, "one for all joints or one per joint, each " + ToText(bound), "", doc);
  }
  void Matrix(const char* key, const Eigen::Matrix3d&, Bound bound, const char* doc) {
    Row(key, "3×3, each " + ToText(bound), "zeros", doc);
  }
  /// A key that is no single value.
  void Row(const char* key, const std::string& allowed, const std::string& standard, std::string doc) {
    for (std::size_t at = doc.find('|'); at != std::string::npos; at = doc.find('|', at + 2))
      doc.replace(at, 1, "\\|");
    out_ << "| " << section_ << (section_.empty() ? "" : ".") << key << " | " << allowed << " | " << standard
         << " | " << doc << " |\n";
  }
  template <typename Enum, std::size_t K>
  void Choice(const char* key, Enum value, const char* const (&names)[K], const char* doc) {
    std::string list;
    for (const char* name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    Row(key, list, names[static_cast<std::size_t>(value)], doc);
  }

 private:
  std::ostringstream& out_;
  std::string section_;
};

template <typename Config>
void List(std::ostringstream& out, const char* section) {
  Config config;
  Lister lister(out, section);
  Fields(lister, config);
}

}  // namespace

std::string KeyReference() {
  std::ostringstream out;
  out << kHead;
  Scenario head;
  Lister lister(out, "scenario");
  ScenarioFields(lister, head);
  out << "| arm | name in config/arms, path, or the arm's table | | which arm |\n";
  List<PlantModelConfig>(out, "plant");
  List<DriveConfig>(out, "drives");
  List<SensorConfig>(out, "sensors");
  List<WallConfig>(out, "wall");
  List<DisturbanceConfig>(out, "disturbance");
  List<LinkConfig>(out, "link");
  List<ReferenceConfig>(out, "reference");
  List<ReferenceLeg>(out, "reference.legs[]");
  List<ForceConfig>(out, "force");
  List<ControlConfig>(out, "control");
  List<LimitConfig>(out, "limits");
  List<TimingConfig>(out, "timing");
  List<FaultConfig>(out, "fault[]");
  List<CheckConfig>(out, "checks[]");
  return out.str();
}

std::string ArmKeyReference() {
  std::ostringstream out;
  out << kHead;
  ArmDescription arm;
  InertialBody body;
  Lister lister(out, ""), truth(out, "truth"), bodies(out, "truth.bodies[]"), shapes(out, "param_shapes[]");
  ArmFields(lister, arm);
  Lister base(out, "base"), joint(out, "joint[]"), tool(out, "tool");
  BaseFields(base, arm.base);
  Joint one;
  Fields(joint, one);
  joint.Row("type", "revolute", "revolute", "the only kind there is");
  lister.Row("dh", "n rows [alpha_(i−1), a_(i−1), d_i, offset_i]: ±2π rad, ±10 m, ±10 m, ±2π rad",
             "`[[joint]]` or this",
             "another way to write the joints: modified (Craig) Denavit-Hartenberg rows, "
             "T_i = Rx(alpha_(i−1)) Tx(a_(i−1)) Rz(θ_i + offset_i) Tz(d_i); offset_i may be left out");
  ToolFields(tool, arm.tool);
  List<ForceSensor>(out, "force_sensor");
  lister.Row("param_names", "up to " + std::to_string(kMaxParameters) + " names", "each link's mass",
             "the uncertain structural parameters p of (28)");
  lister.Row("p_nom", "one per name, within the box", "truth.p", "what the controller starts from");
  lister.Row("p_lo", "one per name, " + ToText(kArmParameter), "0", "box of the projection");
  lister.Row("p_hi", "one per name, not below p_lo", "2 truth.p", "box of the projection");
  shapes.Row("param", "a name of param_names", "needed",
             "which parameter; without shapes one parameter per link scales that link");
  shapes.Row("body", "1 ... n", "needed, or viscous_weights", "which link one unit of the parameter adds to");
  BodyFields(shapes, body, "inertia_com");
  shapes.Row("viscous_weights", "n numbers, 0 ... 10⁴ N·m·s/rad per unit", "",
             "instead of a body: the parameter scales viscous friction");
  List<KnownMass>(out, "known_bodies[]");
  Lister member(out, "member[]");
  member.Row("link", "1 ... n", "needed", "the link that it is a part of: the one that joint moves");
  List<FlexibleMember>(out, "member[]");
  List<Tube>(out, "member[].tube");
  List<Box>(out, "member[].box");
  List<BeamSection>(out, "sections[]");
  List<Tube>(out, "sections[].tube");
  truth.Row("p", "one per name, " + ToText(kArmParameter), "p_nom",
            "true parameters (old place: p_true of the arm)");
  TruthFields(truth, arm);
  BodyFields(bodies, body, "inertia_about_com");
  return out.str();
}

}  // namespace reed
