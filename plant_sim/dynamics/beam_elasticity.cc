#include "reed/plant/dynamics/beam_elasticity.h"

namespace reed::plant {

BeamElasticity::BeamElasticity(double length, double EI, double EA, double GJ)
    : axial(EA / length), torsion(GJ / length) {
  const BendingMat K = EI * IntegrateShapes(length).curvature;
  bending = K.diagonal();
  bending_coupling = K(0, 1);
}

ElasticVec BeamElasticity::Force(const ElasticVec& e) const {
  ElasticVec force;
  for (const int plane : {kA, kB}) {
    force.segment<kBending>(plane) = bending.cwiseProduct(e.segment<kBending>(plane));
    force[plane] += bending_coupling * e[plane + 1];
    force[plane + 1] += bending_coupling * e[plane];
  }
  force[kU] = axial * e[kU];
  force[kTwist] = torsion * e[kTwist];
  return force;
}

}  // namespace reed::plant
