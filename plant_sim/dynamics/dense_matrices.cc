// Dense matrices of the equations of motion, for modes and checks; the sweeps never build them.
#include "reed/plant/dynamics/equations_of_motion.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Jacobian Carried(const Jacobian& parent, const Placement& placement) {
  Jacobian child(6, parent.cols());
  child.topRows<3>() =
      placement.R.transpose() * (parent.topRows<3>() - Cross(placement.p) * parent.bottomRows<3>());
  child.bottomRows<3>() = placement.R.transpose() * parent.bottomRows<3>();
  return child;
}

/// Adds JᵀIJ.
void Add(MatrixXd& M, const Jacobian& J, const Inertia6& inertia) {
  Eigen::Matrix<double, 6, 6> I;
  I << inertia.A, inertia.B, inertia.B.transpose(), inertia.D;
  M += J.transpose() * I * J;
}

Jacobian AtSection(const Jacobian& base, const Section& section, Eigen::Index elastic) {
  Jacobian J = Carried(base, {Matrix3d::Identity(), section.pose().p});
  J.middleCols<kElastic>(elastic) += section.transfer().leftCols<kElastic>();
  return Carried(J, {section.pose().R, Vector3d::Zero()});
}

}  // namespace

MatrixXd EquationsOfMotion::MassMatrix() const {
  MatrixXd M = MatrixXd::Zero(size(), size());
  for (int i = 0; i < n_; ++i) M(i, i) = chain_.drivetrains[static_cast<std::size_t>(i)].rotor_inertia;
  Jacobian J = Jacobian::Zero(6, size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Element& element = chain_.elements[i];
    if (element.joint >= 0) {
      J = Carried(J, nodes_[i].pose);
      J(5, n_ + element.joint) += 1.0;
    } else {
      const MemberWork& work = members_[static_cast<std::size_t>(element.member)];
      const Member& beam = chain_.members[static_cast<std::size_t>(element.member)];
      const Eigen::Index at = ElasticIndex(element.member);
      const Jacobian base = Carried(J, element.mount);
      MatrixXd block = MatrixXd::Zero(kBlock, size());
      block.block<kElastic, kElastic>(0, at).setIdentity();
      block.bottomRows<6>() = base;
      M += block.transpose() * (work.inertia.mass_matrix().selfadjointView<Eigen::Upper>() * block);
      if (beam.body_at >= 0.0) Add(M, AtSection(base, work.body_section, at), beam.body.AtOrigin());
      J = AtSection(base, work.tip, at);
    }
    Add(M, J, nodes_[i].body_inertia);
  }
  return M;
}

MatrixXd EquationsOfMotion::ToolJacobian() const {
  Jacobian J = Jacobian::Zero(6, size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Element& element = chain_.elements[i];
    if (element.joint >= 0) {
      J = Carried(J, nodes_[i].pose);
      J(5, n_ + element.joint) += 1.0;
    } else {
      J = AtSection(Carried(J, element.mount), members_[static_cast<std::size_t>(element.member)].tip,
                    ElasticIndex(element.member));
    }
  }
  return nodes_.back().world.R * Carried(J, {Matrix3d::Identity(), chain_.tool.p}).topRows<3>();
}

MatrixXd EquationsOfMotion::StiffnessMatrix() const {
  MatrixXd K = MatrixXd::Zero(size(), size());
  for (int i = 0; i < n_; ++i) {
    const double k =
        chain_.drivetrains[static_cast<std::size_t>(i)].spring.TangentStiffness(x_[i] - x_[n_ + i]);
    K(i, i) = K(n_ + i, n_ + i) = k;
    K(i, n_ + i) = K(n_ + i, i) = -k;
  }
  for (int m = 0; m < static_cast<int>(members_.size()); ++m)
    for (int e = 0; e < kElastic; ++e)
      K.block<kElastic, 1>(ElasticIndex(m), ElasticIndex(m) + e) =
          chain_.members[static_cast<std::size_t>(m)].elasticity.Force(ElasticVec::Unit(e));
  return K;
}

}  // namespace reed::plant
