#include "reed/plant/dynamics/beam_elasticity.h"

namespace reed::plant {

BeamElasticity::BeamElasticity(double length, double EI_y, double EI_z, double EA, double GJ)
    : axial(EA / length), torsion(GJ / length) {
  const BendingMat curvature = IntegrateShapes(length).curvature;
  const auto plane = [&](double EI) { return Plane{EI * curvature.diagonal(), EI * curvature(0, 1)}; };
  v = plane(EI_z);
  w = plane(EI_y);
}

ElasticVec BeamElasticity::Force(const ElasticVec& e) const {
  ElasticVec force;
  const auto bend = [&](const Plane& plane, int at) {
    force.segment<kBending>(at) = plane.diagonal.cwiseProduct(e.segment<kBending>(at));
    force[at] += plane.coupling * e[at + 1];
    force[at + 1] += plane.coupling * e[at];
  };
  bend(v, kA);
  bend(w, kB);
  force[kU] = axial * e[kU];
  force[kTwist] = torsion * e[kTwist];
  return force;
}

}  // namespace reed::plant
