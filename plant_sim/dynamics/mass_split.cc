#include "plant_sim/dynamics/mass_split.h"

#include <Eigen/Eigenvalues>

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

bool CanExist(const RigidBody& body) {
  const Eigen::Matrix4d pseudo = PseudoInertia(body);
  const double smallest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(pseudo, Eigen::EigenvaluesOnly).eigenvalues()[0];
  return body.mass >= 0.0 && smallest >= -1e-9 * pseudo.norm();
}

RigidBody Rest(const RigidBody& body, const std::vector<LinkMember>& members, double share, bool with_polar) {
  RigidBody rest = body;
  for (const LinkMember& member : members) {
    const BeamInertia line(member.length, share * member.density, with_polar ? share * member.polar : 0.0);
    rest = Without(rest, InParent(member.base, line.AsRigidBody()));
  }
  return rest;
}

}  // namespace

RigidBody SplitMass(const RigidBody& body, std::vector<LinkMember>& members) {
  // A body given as a thin rod has no inertia about its axis to share.
  const bool with_polar =
      CanExist(Rest(body, members, 1.0, true)) || !CanExist(Rest(body, members, 1.0, false));
  double share = 1.0;
  if (!CanExist(Rest(body, members, share, with_polar))) {
    double possible = 0.0, impossible = 1.0;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (possible + impossible);
      (CanExist(Rest(body, members, middle, with_polar)) ? possible : impossible) = middle;
    }
    share = possible;
  }
  const RigidBody rest = Rest(body, members, share, with_polar);
  for (LinkMember& member : members) {
    const double polar_share = with_polar ? share : 0.0;
    member.relative = {(1.0 - share) * member.density, (1.0 - polar_share) * member.polar};
    member.density *= share;
    member.polar *= polar_share;
  }
  return rest;
}

}  // namespace reed::plant
