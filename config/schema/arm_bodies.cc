#include "reed/config/schema/arm_bodies.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace reed {
namespace {

constexpr Bound kMass{"kg", 0.0, 500.0};
constexpr Bound kMoment{"kg·m²", -500.0, 500.0};

using Numbers = std::vector<double>;

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

}  // namespace

std::vector<Numbers> ReadRows(Reader& in, const char* key, std::size_t width) {
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

InertialBody ReadBody(Reader& in, const char* inertia_key, bool first_link) {
  InertialBody body;
  if (!in.Has("mass")) in.Fail("mass", "missing; kg");
  in.Number("mass", body.mass_kg, kMass, "");
  in.Vector("com", body.com_m, kLength, "");
  const std::vector<Numbers> rows = ReadRows(in, inertia_key, 3);
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

void ReadBodies(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "bodies", [&](Reader& item, std::size_t i) {
    item.Get("frame");
    arm.bodies.push_back(ReadBody(item, "inertia_about_com", i == 0));
  });
  if (arm.bodies.size() != arm.dh.size())
    in.Fail("bodies", std::to_string(arm.bodies.size()) + " bodies for " + std::to_string(arm.dh.size()) +
                          " joints; one per link");
  double total = 0.0;
  for (const InertialBody& body : arm.bodies) total += body.mass_kg;
  if (total <= 0.0) in.Fail("bodies", "the arm has no mass; allowed: more than 0 kg in all");
}
}  // namespace reed
