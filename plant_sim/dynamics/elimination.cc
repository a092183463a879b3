#include "reed/plant/dynamics/elimination.h"

#include "reed/plant/dynamics/block_kernels.h"

namespace reed::plant {

static_assert(kBlock == kBlockSize && kElastic == kPivots);

using Eigen::Matrix3d;

void ElementBlock::Carry(const Section& section, const Inertia6& inertia, const Wrench& force) {
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> I;
  I.topLeftCorner<3, 3>() = inertia.A;
  I.topRightCorner<3, 3>() = inertia.B;
  I.bottomLeftCorner<3, 3>() = inertia.B.transpose();
  I.bottomRightCorner<3, 3>() = inertia.D;
  const Section::Transfer& X = section.transfer();
  AddCongruence(M_.data(), X.data(), I.data());
  for (int i = 0; i < 3; ++i)
    p_ += X.row(i).transpose() * force.force[i] + X.row(3 + i).transpose() * force.moment[i];
}

void ElementBlock::AddElastic(const BeamElasticity& elasticity, double weight, const ElasticVec& reach) {
  p_.head<kElastic>() -= elasticity.Force(reach);
  const auto bend = [&](const BeamElasticity::Plane& plane, int at) {
    M_.diagonal().segment<kBending>(at) += weight * plane.diagonal;
    M_(at, at + 1) += weight * plane.coupling;
  };
  bend(elasticity.v, kA);
  bend(elasticity.w, kB);
  M_(kU, kU) += weight * elasticity.axial;
  M_(kTwist, kTwist) += weight * elasticity.torsion;
}

void ElementBlock::Eliminate(Inertia6& inertia, Wrench& force) {
  EliminateLeading(M_.data(), p_.data(), pivot_inverse_.data());
  inertia.A = M_.block<3, 3>(kLinear, kLinear).selfadjointView<Eigen::Upper>();
  inertia.B = M_.block<3, 3>(kLinear, kAngular);
  inertia.D = M_.block<3, 3>(kAngular, kAngular).selfadjointView<Eigen::Upper>();
  force = {p_.segment<3>(kLinear), p_.segment<3>(kAngular)};
}

BlockVec ElementBlock::BackSubstitute(const Rate& base) const {
  BlockVec k;
  k.segment<3>(kLinear) = base.linear;
  k.segment<3>(kAngular) = base.angular;
  plant::BackSubstitute(M_.data(), p_.data(), pivot_inverse_.data(), k.data());
  return k;
}

}  // namespace reed::plant
