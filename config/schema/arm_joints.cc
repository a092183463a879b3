#include "reed/config/schema/arm_joints.h"

#include <algorithm>

#include "reed/config/schema/arm_bodies.h"
#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/text_limits.h"

namespace reed {
namespace {

using Numbers = std::vector<double>;

void CheckWithin(Reader& in, const toml::node* where, const std::string& key, double value,
                 const Bound& bound, const char* hint) {
  if (value < bound.lo || value > bound.hi)
    in.document().Fail(where, in.KeyName(key),
                       ToText(value) + " is out of range; allowed: " + ToText(bound) + " (" + hint + ")");
}

/// Rows of three numbers, or of four where the angles have offsets.
std::vector<Joint> ReadDh(Reader& in) {
  const std::vector<Numbers> rows = in.Rows("dh", 3, 4);
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string name = "dh[" + std::to_string(i) + "]";
    const toml::node* where = in.Get("dh")->as_array()->get(i);
    CheckWithin(in, where, name, rows[i][0], kArmAngle, "alpha is in radians");
    CheckWithin(in, where, name, rows[i][1], kArmLength, "a is in metres");
    CheckWithin(in, where, name, rows[i][2], kArmLength, "d is in metres");
    const double offset_rad = rows[i].size() > 3 ? rows[i][3] : 0.0;
    CheckWithin(in, where, name, offset_rad, kArmAngle, "the offset of the angle is in radians");
    joints.push_back(JointOf({rows[i][0], rows[i][1], rows[i][2], offset_rad}));
  }
  return joints;
}

/// Names go into pictures, logs and URDF files.
void CheckName(Reader& in, const char* key, const std::string& name) {
  const auto printable = [](char c) { return c > ' ' && c <= '~'; };
  if (name.size() > kLongestName || !std::all_of(name.begin(), name.end(), printable))
    in.Fail(key, "allowed: up to " + std::to_string(kLongestName) + " printable ASCII characters, no space");
}

/// Only one kind is built; a file may say so.
void CheckType(Reader& in) {
  std::string type = "revolute";
  in.Text("type", type, "");
  if (type != "revolute")
    in.Fail("type",
            "'" + type + "' joints are not supported; allowed: revolute, about z of the joint's frame");
}

std::vector<Joint> ReadTables(Reader& in) {
  std::vector<Joint> joints;
  ForEachTable(in, "joint", [&](Reader& item, std::size_t) {
    Joint joint;
    CheckType(item);
    Fields(item, joint);
    CheckName(item, "name", joint.name);
    CheckName(item, "frame", joint.frame);
    for (const Joint& before : joints) {
      if (!joint.name.empty() && joint.name == before.name)
        item.Fail("name", "'" + joint.name + "' is given twice");
      if (!joint.frame.empty() && joint.frame == before.frame)
        item.Fail("frame", "'" + joint.frame + "' is given twice; the chain is serial, one frame per link");
    }
    joints.push_back(joint);
  });
  return joints;
}

}  // namespace

toml::table* SectionOf(Reader& in, const char* key) {
  toml::node* node = in.Get(key);
  if (node != nullptr && !node->is_table()) in.Fail(key, "expected a section [" + in.KeyName(key) + "]");
  return node == nullptr ? nullptr : node->as_table();
}

std::vector<Joint> ReadJoints(Reader& in) {
  if (in.Has("joint") && in.Has("dh")) in.Fail("dh", "stands beside [[joint]]; allowed: one of them");
  const char* key = in.Has("joint") ? "joint" : "dh";
  std::vector<Joint> joints = in.Has("joint") ? ReadTables(in) : ReadDh(in);
  if (joints.empty())
    in.Fail(key, "missing; one row [alpha_{i-1} rad, a_{i-1} m, d_i m] per joint, or one [[joint]] each");
  if (joints.size() > static_cast<std::size_t>(kMaxJoints))
    in.Fail(key, std::to_string(joints.size()) + " joints; allowed: 1 ... " + std::to_string(kMaxJoints));
  return joints;
}

void ReadBaseAndTool(Reader& in, ArmDescription& arm) {
  Reader base(in.document(), SectionOf(in, "base"), in.KeyName("base"));
  BaseFields(base, arm.base);
  base.RefuseUnknown();
  Reader tool(in.document(), SectionOf(in, "tool"), in.KeyName("tool"));
  for (const char* older : {"tool_offset_in_last_frame", "tool_offset"}) {
    if (in.Has(older) && tool.Has("xyz_m"))
      in.Fail(older, "given twice; it is " + tool.KeyName("xyz_m") + " now");
    in.Vector(older, arm.tool.xyz_m, kArmLength, "");
  }
  ToolFields(tool, arm.tool);
  tool.RefuseUnknown();
}

void ReadForceSensor(Reader& in, ArmDescription& arm) {
  static_cast<FixedFrame&>(arm.force_sensor) = arm.tool;
  Reader sensor(in.document(), SectionOf(in, "force_sensor"), in.KeyName("force_sensor"));
  Fields(sensor, arm.force_sensor);
  sensor.RefuseUnknown();
}

}  // namespace reed
