#include "plant_sim/dynamics/beam_elasticity.h"

namespace reed::plant {

BeamElasticity::BeamElasticity(double length, double EI, double EA, double GJ) {
  const BendingMat bending = EI * IntegrateShapes(length).curvature;
  K.block<kBending, kBending>(kA, kA) = bending;
  K.block<kBending, kBending>(kB, kB) = bending;
  K(kU, kU) = EA / length;
  K(kTwist, kTwist) = GJ / length;
}

}  // namespace reed::plant
