#include "reed/config/schema/arm_parameters.h"

#include <algorithm>

#include "reed/config/schema/arm_bodies.h"
#include "reed/config/schema/arm_fields.h"
#include "reed/config/schema/known_mass.h"
#include "reed/config/schema/true_parameters.h"

namespace reed {
namespace {

using Numbers = std::vector<double>;

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
ParameterShape MassShape(const Reader& in, const ArmDescription& arm, int link) {
  const InertialBody& body = arm.bodies[static_cast<std::size_t>(link)];
  const Eigen::Matrix3d inertia = body.inertia_com_kgm2 / body.mass_kg;
  if (inertia.cwiseAbs().maxCoeff() > kArmMoment.hi)
    in.Fail("bodies", "body " + std::to_string(link + 1) + ": mass " + ToText(body.mass_kg) +
                          " kg is too small for its inertia (" + ToShortText(inertia.cwiseAbs().maxCoeff()) +
                          " m² per kg; allowed: up to " + ToText(kArmMoment.hi) + ")");
  return {link, {1.0, body.com_m, inertia}};
}

/// Without a list of parameters every link's mass is one.
void DefaultParameters(const Reader& in, ArmDescription& arm) {
  for (int i = 0; i < arm.dof(); ++i) {
    const double mass = arm.bodies[static_cast<std::size_t>(i)].mass_kg;
    if (mass > 0.0)
      arm.parameters.push_back(
          {"m" + std::to_string(i + 1), mass, mass, 0.0, 2.0 * mass, {MassShape(in, arm, i)}, {}});
  }
}

/// The true values, where the file says them: p of [truth], or p_true beside the nominal ones.
Numbers ReadTruth(Reader& in, Reader& truth) {
  Numbers old_place, p;
  in.Numbers("p_true", old_place, kArmParameter, "");
  truth.Numbers("p", p, kArmParameter, "");
  if (!old_place.empty() && !p.empty()) in.Fail("p_true", "given twice; it is truth.p now");
  return old_place.empty() ? p : old_place;
}

/// Values and boxes of the named parameters.
void ReadValues(Reader& in, Reader& true_place, const std::vector<std::string>& names, ArmDescription& arm) {
  Numbers truth = ReadTruth(in, true_place), nominal, lo, hi;
  in.Numbers("p_nom", nominal, kArmParameter, "");
  in.Numbers("p_lo", lo, kArmParameter, "");
  in.Numbers("p_hi", hi, kArmParameter, "");
  if (truth.empty()) truth = nominal;
  if (nominal.empty()) nominal = truth;
  if (lo.empty()) lo.assign(truth.size(), 0.0);
  if (hi.empty())
    std::transform(truth.begin(), truth.end(), std::back_inserter(hi), [](double p) { return 2.0 * p; });
  const auto one_per_name = [&](Reader& place, const char* key, const Numbers& list) {
    if (list.size() != names.size())
      place.Fail(key,
                 std::to_string(list.size()) + " numbers for " + std::to_string(names.size()) + " names");
  };
  if (true_place.Has("p"))
    one_per_name(true_place, "p", truth);
  else
    one_per_name(in, in.Has("p_true") ? "p_true" : "p_nom", truth);
  one_per_name(in, "p_nom", nominal);
  one_per_name(in, "p_lo", lo);
  one_per_name(in, "p_hi", hi);
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
}

/// Named parameters without shapes are the links' masses, in order.
void ShapesOfMasses(Reader& in, ArmDescription& arm) {
  if (arm.parameters.size() != arm.bodies.size())
    in.Fail("param_shapes", "missing; without it one parameter per link, its mass");
  for (int i = 0; i < arm.dof(); ++i) {
    if (arm.bodies[static_cast<std::size_t>(i)].mass_kg <= 0.0)
      in.Fail("param_shapes", "missing, and body " + std::to_string(i + 1) + " has no mass to scale");
    arm.parameters[static_cast<std::size_t>(i)].shapes.push_back(MassShape(in, arm, i));
  }
}

/// [[param_shapes]]
void ReadShapes(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "param_shapes", [&](Reader& item, std::size_t) {
    std::string name;
    item.Text("param", name, "");
    const auto found = std::find_if(arm.parameters.begin(), arm.parameters.end(),
                                    [&](const auto& p) { return p.name == name; });
    if (found == arm.parameters.end()) item.Fail("param", "'" + name + "' is not in param_names");
    if (item.Has("viscous_weights")) {
      item.Numbers("viscous_weights", found->viscous_weights, {"N·m·s/rad", 0.0, 1e4}, "");
      if (found->viscous_weights.size() != arm.joints.size())
        item.Fail("viscous_weights", "expected one number per joint");
      return;
    }
    ParameterShape shape;
    int body = 0;
    if (!item.Has("body")) item.Fail("body", "missing; 1 ... " + std::to_string(arm.dof()));
    item.Integer("body", body, {"1", 1.0, static_cast<double>(arm.dof())}, "");
    shape.body = body - 1;
    shape.unit = ReadBody(item, "inertia_com", body == 1);
    found->shapes.push_back(shape);
  });
}

/// A file with known_bodies alone: the parameters add to them.
void BodiesFromParameters(ArmDescription& arm) {
  for (const KnownMass& mass : arm.known) arm.bodies.push_back(BodyOf(mass));
  for (const StructuralParameter& parameter : arm.parameters)
    for (const ParameterShape& shape : parameter.shapes)
      Add(arm.bodies[static_cast<std::size_t>(shape.body)], parameter.truth, shape.unit);
}

/// Bodies that stand beside the nominal values include those; the true ones follow from the truth.
void MoveBodies(ArmDescription& arm) {
  Numbers truth;
  for (StructuralParameter& parameter : arm.parameters) {
    truth.push_back(parameter.truth);
    parameter.truth = parameter.nominal;
  }
  SetTrueParameters(arm, truth);
}

}  // namespace

void ReadParameters(Reader& in, Reader& truth, ArmDescription& arm) {
  const std::vector<std::string> names = ReadNames(in, "param_names");
  if (names.size() > static_cast<std::size_t>(kMaxParameters))
    in.Fail("param_names",
            std::to_string(names.size()) + " parameters; allowed: 0 ... " + std::to_string(kMaxParameters));
  if (names.empty()) {
    if (in.Has("p_true") || in.Has("param_shapes"))
      in.Fail("param_names", "missing; one name per entry of p_true");
    if (truth.Has("p")) in.Fail("param_names", "missing; one name per entry of truth.p");
    Numbers of_nobody;
    for (const char* key : {"p_nom", "p_lo", "p_hi"}) in.Numbers(key, of_nobody, kArmParameter, "");
    if (arm.known.empty()) DefaultParameters(in, arm);
  } else {
    ReadValues(in, truth, names, arm);
    if (!in.Has("param_shapes")) ShapesOfMasses(in, arm);
    ReadShapes(in, arm);
  }
  if (arm.bodies.empty())
    BodiesFromParameters(arm);
  else if (in.Has("bodies") && truth.Has("p"))
    MoveBodies(arm);
}

}  // namespace reed
