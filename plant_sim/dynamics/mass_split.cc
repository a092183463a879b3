#include "reed/plant/dynamics/mass_split.h"

#include <algorithm>

#include "reed/plant/dynamics/symmetric_eigen.h"

namespace reed::plant {

namespace {

/// Second moments of mass [∫r rᵀ dm, ∫r dm; ·, m]: a body can exist if and only if none of the eigenvalues is
/// negative.
Eigen::Matrix4d PseudoInertia(const RigidBody& body) {
  const Eigen::Matrix3d second = 0.5 * body.inertia.trace() * Eigen::Matrix3d::Identity() - body.inertia +
                                 body.mass * body.com * body.com.transpose();
  Eigen::Matrix4d pseudo;
  pseudo << second, body.mass * body.com, body.mass * body.com.transpose(), body.mass;
  return pseudo;
}

bool CanExist(const Eigen::Matrix4d& pseudo) {
  constexpr double kRoundOff = 1e-13;
  return SymmetricEigenvalues(pseudo)[0] >= -kRoundOff * pseudo.norm();
}

/// The members' lines as bodies, in the link frame.
std::vector<RigidBody> Lines(const std::vector<LinkMember>& members, double mass_share, double polar_share) {
  std::vector<RigidBody> lines;
  for (const LinkMember& member : members) {
    const BeamInertia line(member.length, mass_share * member.density, polar_share * member.polar);
    lines.push_back(InParent(member.base, line.AsRigidBody()));
  }
  return lines;
}

/// The largest share up to `most` that leaves a body that can exist.
template <typename LinesOf>
double LargestShare(const RigidBody& body, double most, LinesOf lines_of) {
  const auto possible = [&](double share) {
    Eigen::Matrix4d rest = PseudoInertia(body);
    for (const RigidBody& line : lines_of(share)) rest -= PseudoInertia(line);
    return CanExist(rest);
  };
  if (possible(most)) return most;
  double lo = 0.0, hi = most;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (lo + hi);
    (possible(middle) ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace

RigidBody SplitMass(const RigidBody& body, std::vector<LinkMember>& members) {
  if (members.empty()) return body;
  double structure = 0.0;
  for (const LinkMember& member : members) structure += member.density * member.length;
  if (structure == 0.0) return body;
  const double mass_share =
      LargestShare(body, body.mass / structure, [&](double share) { return Lines(members, share, 0.0); });
  const double polar_share =
      LargestShare(body, 1.0, [&](double share) { return Lines(members, mass_share, share); });
  RigidBody rest = body;
  for (const RigidBody& line : Lines(members, mass_share, polar_share)) rest = Without(rest, line);
  for (LinkMember& member : members) {
    member.relative.density = std::max(0.0, 1.0 - mass_share) * member.density;
    member.relative.polar = (1.0 - polar_share) * member.polar;
    member.density *= mass_share;
    member.polar *= polar_share;
  }
  return rest;
}

}  // namespace reed::plant
