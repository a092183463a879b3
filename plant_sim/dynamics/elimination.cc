#include "plant_sim/dynamics/elimination.h"

#include "plant_sim/dynamics/block_kernels.h"

namespace reed::plant {

static_assert(kBlock == kBlockSize);

using Eigen::Matrix3d;
using Eigen::Vector3d;

void ElementBlock::Carry(const Section& section, const Inertia6& inertia, const Wrench& force) {
  // X: [k_e | k_base] -> rate of the section.
  Eigen::Matrix<double, 6, kBlock, Eigen::RowMajor> X;
  X.leftCols<kElastic>() = section.jacobian();
  X.rightCols<6>().setIdentity();
  X.block<3, 3>(0, kAngular) = -Cross(section.pose().p);

  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> I;
  I << inertia.A, inertia.B, inertia.B.transpose(), inertia.D;
  Eigen::Matrix<double, 6, 1> f;
  f << force.force, force.moment;

  AddCongruence(M_.data(), X.data(), I.data());
  p_ += X.transpose() * f;
}

void ElementBlock::Eliminate(Inertia6& inertia, Wrench& force) {
  EliminateLeading(M_.data(), p_.data(), pivot_inverse_.data(), kElastic);
  const auto left = M_.bottomRightCorner<6, 6>().selfadjointView<Eigen::Upper>();
  const Eigen::Matrix<double, 6, 6> I = left;
  inertia = {I.topLeftCorner<3, 3>(), I.topRightCorner<3, 3>(), I.bottomRightCorner<3, 3>()};
  force = {p_.segment<3>(kLinear), p_.segment<3>(kAngular)};
}

void ElementBlock::BackSubstitute(const Rate& base, Eigen::Ref<Eigen::VectorXd> k_e) const {
  BlockVec k;
  k.segment<3>(kLinear) = base.linear;
  k.segment<3>(kAngular) = base.angular;
  for (int row = kElastic - 1; row >= 0; --row) {
    const int right = kBlock - row - 1;
    k[row] = -(p_[row] + M_.row(row).tail(right).dot(k.tail(right))) * pivot_inverse_[row];
  }
  k_e = k.head<kElastic>();
}

}  // namespace reed::plant
