#include "reed/config/schema/arm_bodies.h"

#include <Eigen/Eigenvalues>

#include "reed/config/schema/arm_fields.h"

namespace reed {
namespace {

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

void OnePerLink(Reader& in, const char* key, std::size_t count, const ArmDescription& arm) {
  if (count != arm.joints.size())
    in.Fail(key, std::to_string(count) + " bodies for " + std::to_string(arm.joints.size()) +
                     " joints; one per link");
}

}  // namespace

InertialBody ReadBody(Reader& in, const char* inertia_key, bool first_link) {
  InertialBody body;
  BodyFields(in, body, inertia_key);
  CheckInertia(in, inertia_key, body.inertia_com_kgm2, first_link && IsOnlyAboutZ(body));
  return body;
}

void ReadBodies(Reader& in, ArmDescription& arm) {
  ForEachTable(in, "bodies", [&](Reader& item, std::size_t i) {
    item.Get("frame");
    arm.bodies.push_back(ReadBody(item, "inertia_about_com", i == 0));
  });
  OnePerLink(in, "bodies", arm.bodies.size(), arm);
  double total = 0.0;
  for (const InertialBody& body : arm.bodies) total += body.mass_kg;
  if (total <= 0.0) in.Fail("bodies", "the arm has no mass; allowed: more than 0 kg in all");
}

void ReadKnownBodies(Reader& in, ArmDescription& arm) {
  if (!in.Has("known_bodies")) return;
  ForEachTable(in, "known_bodies", [&](Reader& item, std::size_t) {
    KnownMass mass;
    Fields(item, mass);
    arm.known.push_back(mass);
  });
  OnePerLink(in, "known_bodies", arm.known.size(), arm);
}

}  // namespace reed
