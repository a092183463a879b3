#include "config/schema/arm_file.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "config/schema/reader.h"

namespace reed {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr Bound kAngle{"rad", -kTwoPi, kTwoPi};  // beyond: degrees
constexpr Bound kLength{"m", -10.0, 10.0};       // beyond: millimetres
constexpr Bound kMass{"kg", 0.0, 500.0};
constexpr Bound kMoment{"kg·m²", -500.0, 500.0};
constexpr Bound kGravity{"m/s²", -30.0, 30.0};

constexpr double kDefaultRange_rad = 2.9;
constexpr double kDefaultSpeed_radps = 3.0;

using Numbers = std::vector<double>;

/// A list of equally long rows of numbers.
std::vector<Numbers> Rows(Reader& in, const char* key, std::size_t width) {
  toml::node* node = in.Get(key);
  std::vector<Numbers> rows;
  if (node == nullptr) return rows;
  const toml::array* array = node->as_array();
  if (array == nullptr) in.Fail(key, "expected a list of rows of " + std::to_string(width) + " numbers");
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string name = std::string(key) + "[" + std::to_string(i) + "]";
    const toml::array* row = (*array)[i].as_array();
    if (row == nullptr || row->size() != width)
      in.document().Fail(&(*array)[i], in.KeyName(name),
                         "expected a row of " + std::to_string(width) + " numbers");
    Numbers numbers;
    for (const toml::node& cell : *row) {
      const auto number = cell.value<double>();
      if (!number || !std::isfinite(*number))
        in.document().Fail(&cell, in.KeyName(name), "expected a finite number");
      numbers.push_back(*number);
    }
    rows.push_back(numbers);
  }
  return rows;
}

void CheckWithin(Reader& in, const toml::node* where, const std::string& key, double value,
                 const Bound& bound, const char* hint) {
  if (value < bound.lo || value > bound.hi)
    in.document().Fail(where, in.KeyName(key),
                       ToText(value) + " is out of range; allowed: " + ToText(bound) + " (" + hint + ")");
}

std::vector<DhRow> ReadDh(Reader& in) {
  const std::vector<Numbers> rows = Rows(in, "dh", 3);
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

/// A rigid body's inertia about its centre of mass: symmetric, no negative moment, each at most the sum of
/// the others.
void CheckInertia(Reader& in, const std::string& key, const Eigen::Matrix3d& inertia, bool only_about_z) {
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-9 * (1.0 + inertia.cwiseAbs().maxCoeff()))
    in.Fail(key, "not symmetric");
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  const double tolerance = 1e-9 + 1e-6 * moments.cwiseAbs().maxCoeff();
  if (moments[0] < -tolerance)
    in.Fail(key, "no body has a negative principal moment (" + ToText(moments[0]) + " kg·m²)");
  if (!only_about_z && moments[2] > moments[0] + moments[1] + tolerance)
    in.Fail(key, "no body has these principal moments: " + ToText(moments[2]) + " > " + ToText(moments[0]) +
                     " + " + ToText(moments[1]) + " kg·m² (triangle inequality)");
}

/// The first link only turns about its own fixed z axis: one moment is all that can be known or matter.
bool IsOnlyAboutZ(const InertialBody& body) {
  Eigen::Matrix3d rest = body.inertia_com_kgm2;
  rest(2, 2) = 0.0;
  return body.mass_kg == 0.0 && rest.isZero();
}

InertialBody ReadBody(Reader& in, const char* inertia_key, bool first_link, const Bound& mass_bound) {
  InertialBody body;
  if (!in.Has("mass")) in.Fail("mass", "missing; kg");
  in.Number("mass", body.mass_kg, mass_bound, "");
  in.Vector("com", body.com_m, kLength, "");
  const std::vector<Numbers> rows = Rows(in, inertia_key, 3);
  if (!rows.empty()) {
    if (rows.size() != 3) in.Fail(inertia_key, "expected three rows of three numbers in kg·m²");
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        body.inertia_com_kgm2(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    if (body.inertia_com_kgm2.cwiseAbs().maxCoeff() > kMoment.hi)
      in.Fail(inertia_key, "out of range; allowed: " + ToText(kMoment));
    CheckInertia(in, inertia_key, body.inertia_com_kgm2, first_link && IsOnlyAboutZ(body));
  }
  return body;
}

template <typename Each>
void ForEachTable(Reader& in, const char* key, Each each) {
  toml::node* node = in.Get(key);
  if (node == nullptr) return;
  toml::array* array = node->as_array();
  if (array == nullptr) in.Fail(key, "expected a list of tables");
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string name = std::string(key) + "[" + std::to_string(i) + "]";
    toml::table* table = (*array)[i].as_table();
    if (table == nullptr) in.document().Fail(&(*array)[i], in.KeyName(name), "expected a table");
    Reader item(in.document(), table, in.KeyName(name));
    each(item, i);
    item.RefuseUnknown();
  }
}

void ReadBodies(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "bodies", [&](Reader& item, std::size_t i) {
    item.Get("frame");
    arm.bodies.push_back(ReadBody(item, "inertia_about_com", i == 0, kMass));
  });
  if (arm.bodies.size() != arm.dh.size())
    in.Fail("bodies", std::to_string(arm.bodies.size()) + " bodies for " + std::to_string(arm.dh.size()) +
                          " joints; one per link");
  double total = 0.0;
  for (const InertialBody& body : arm.bodies) total += body.mass_kg;
  if (total <= 0.0) in.Fail("bodies", "the arm has no mass; allowed: more than 0 kg in all");
}

std::vector<std::string> ReadNames(Reader& in, const char* key) {
  toml::node* node = in.Get(key);
  std::vector<std::string> names;
  if (node == nullptr) return names;
  const toml::array* array = node->as_array();
  if (array == nullptr) in.Fail(key, "expected a list of names");
  for (const toml::node& item : *array) {
    const auto name = item.value_exact<std::string>();
    if (!name) in.Fail(key, "expected a list of names");
    names.push_back(*name);
  }
  return names;
}

/// What one unit of mass adds to a link when the file gives no shapes: its own com and inertia, scaled.
ParameterShape MassShape(const ArmDescription& arm, int link) {
  const InertialBody& body = arm.bodies[static_cast<std::size_t>(link)];
  return {link, {1.0, body.com_m, body.inertia_com_kgm2 / body.mass_kg}};
}

/// Without a list of parameters every link's mass is one.
void DefaultParameters(ArmDescription& arm) {
  for (int i = 0; i < arm.dof(); ++i) {
    const double mass = arm.bodies[static_cast<std::size_t>(i)].mass_kg;
    if (mass > 0.0)
      arm.parameters.push_back(
          {"m" + std::to_string(i + 1), mass, mass, 0.0, 2.0 * mass, {MassShape(arm, i)}, {}});
  }
}

void ReadParameters(Reader& in, ArmDescription& arm) {
  constexpr Bound kParameter{"unit of the parameter", -1e3, 1e3};
  const std::vector<std::string> names = ReadNames(in, "param_names");
  Numbers truth, nominal, lo, hi;
  in.Numbers("p_true", truth, kParameter, "");
  in.Numbers("p_nom", nominal, kParameter, "");
  in.Numbers("p_lo", lo, kParameter, "");
  in.Numbers("p_hi", hi, kParameter, "");
  if (names.empty()) {
    if (in.Has("p_true") || in.Has("param_shapes"))
      in.Fail("param_names", "missing; one name per entry of p_true");
    in.Get("param_shapes");
    DefaultParameters(arm);
    return;
  }
  if (names.size() > static_cast<std::size_t>(kMaxParameters))
    in.Fail("param_names",
            std::to_string(names.size()) + " parameters; allowed: 0 ... " + std::to_string(kMaxParameters));
  if (nominal.empty()) nominal = truth;
  if (lo.empty()) lo.assign(truth.size(), 0.0);
  if (hi.empty())
    std::transform(truth.begin(), truth.end(), std::back_inserter(hi), [](double p) { return 2.0 * p; });
  for (const auto& [key, list] :
       {std::pair{"p_true", &truth}, {"p_nom", &nominal}, {"p_lo", &lo}, {"p_hi", &hi}})
    if (list->size() != names.size())
      in.Fail(key, std::to_string(list->size()) + " numbers for " + std::to_string(names.size()) + " names");
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (lo[k] > hi[k])
      in.Fail("p_lo", names[k] + ": the box is empty, " + ToText(lo[k]) + " > " + ToText(hi[k]));
    if (nominal[k] < lo[k] || nominal[k] > hi[k])
      in.Fail("p_nom", names[k] + ": start " + ToText(nominal[k]) + " lies outside the box " + ToText(lo[k]) +
                           " ... " + ToText(hi[k]));
    StructuralParameter parameter;
    parameter.name = names[k];
    parameter.truth = truth[k];
    parameter.nominal = nominal[k];
    parameter.lo = lo[k];
    parameter.hi = hi[k];
    arm.parameters.push_back(parameter);
  }
  if (!in.Has("param_shapes")) {
    // Named parameters without shapes are the links' masses, in order.
    if (names.size() != arm.bodies.size())
      in.Fail("param_shapes", "missing; without it one parameter per link, its mass");
    for (int i = 0; i < arm.dof(); ++i) {
      if (arm.bodies[static_cast<std::size_t>(i)].mass_kg <= 0.0)
        in.Fail("param_shapes", "missing, and body " + std::to_string(i + 1) + " has no mass to scale");
      arm.parameters[static_cast<std::size_t>(i)].shapes.push_back(MassShape(arm, i));
    }
  }
  ForEachTable(in, "param_shapes", [&](Reader& item, std::size_t) {
    std::string name;
    item.Text("param", name, "");
    const auto found = std::find_if(arm.parameters.begin(), arm.parameters.end(),
                                    [&](const auto& p) { return p.name == name; });
    if (found == arm.parameters.end()) item.Fail("param", "'" + name + "' is not in param_names");
    if (item.Has("viscous_weights")) {
      item.Numbers("viscous_weights", found->viscous_weights, {"N·m·s/rad", 0.0, 1e4}, "");
      if (found->viscous_weights.size() != arm.dh.size())
        item.Fail("viscous_weights", "expected one number per joint");
      return;
    }
    ParameterShape shape;
    int body = 0;
    if (!item.Has("body")) item.Fail("body", "missing; 1 ... " + std::to_string(arm.dof()));
    item.Integer("body", body, {"1", 1.0, static_cast<double>(arm.dof())}, "");
    shape.body = body - 1;
    shape.unit = ReadBody(item, "inertia_com", body == 1, kMass);
    found->shapes.push_back(shape);
  });
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
