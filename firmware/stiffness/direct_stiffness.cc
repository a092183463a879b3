#include "reed/firmware/stiffness/direct_stiffness.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <stdexcept>

#include "reed/firmware/stiffness/member_stiffness.h"
#include "reed/firmware/stiffness/semidefinite_solver.h"

namespace reed::model {

int DirectStiffness::AddNode(const Eigen::Vector3d& position, int master, int coordinates) {
  if (master != kNone && Index(master) >= nodes_.size()) throw std::invalid_argument("no such master node");
  nodes_.push_back({position, master, num_coordinates_, coordinates});
  num_coordinates_ += coordinates;
  return static_cast<int>(nodes_.size()) - 1;
}

Eigen::Vector3d DirectStiffness::Between(int from, int to) const {
  const Eigen::Vector3d r = nodes_.at(Index(to)).position - nodes_.at(Index(from)).position;
  if (!(r.norm() > 0.0)) throw std::invalid_argument("a member needs two nodes apart");
  return r;
}

void DirectStiffness::AddMember(int from, int to, const SectionStiffness& section, const Eigen::Vector3d& y,
                                const Eigen::Vector3d& spread_force) {
  const Eigen::Vector3d r = Between(from, to);
  const double L = r.norm();
  Eigen::Matrix3d axes;
  axes << r / L, y, (r / L).cross(y);
  members_.push_back(
      {from, to, MemberStiffness(axes, L, section), EquivalentNodalLoad(r / L, L, spread_force)});
}

void DirectStiffness::AddMember(int from, int to, double EA, double EI, double GJ,
                                const Eigen::Vector3d& spread_force) {
  AddMember(from, to, {EA, EI, EI, GJ}, Between(from, to).unitOrthogonal(), spread_force);
}

Eigen::MatrixXd DirectStiffness::Map(int id) const {
  const Node& node = nodes_.at(Index(id));
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(6, num_coordinates_);
  if (node.coordinates == 6) T.middleCols<6>(node.first).setIdentity();
  if (node.master == kNone) return T;
  T = Map(node.master);
  const Eigen::Vector3d r = node.position - nodes_[Index(node.master)].position;
  for (int k = 0; k < num_coordinates_; ++k) {
    T.col(k).head<3>() += Eigen::Vector3d(T.col(k).tail<3>()).cross(r);  // u_j = u_i + φ_i × r
  }
  if (node.coordinates == 1) T.col(node.first).tail<3>() += node.axis;  // (6) Ω^e (Δt_i - Δt_j) = ξ
  return T;
}

Eigen::MatrixXd DirectStiffness::Aggregate() const {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(num_coordinates_, num_coordinates_);
  for (const Beam& beam : members_) {
    Eigen::MatrixXd T(12, num_coordinates_);
    T << Map(beam.from), Map(beam.to);
    K += T.transpose() * beam.K * T;
  }
  for (const Node& node : nodes_) {
    if (node.coordinates == 1) K(node.first, node.first) += node.k_q;  // (6) Ω^e W = k_q ξ
  }
  return 0.5 * (K + K.transpose());
}

Eigen::VectorXd DirectStiffness::Load() const {
  Eigen::VectorXd W = Eigen::VectorXd::Zero(num_coordinates_);
  for (const Beam& beam : members_) {
    W += Map(beam.from).transpose() * beam.load.head<6>() + Map(beam.to).transpose() * beam.load.tail<6>();
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) W += Map(static_cast<int>(i)).transpose() * nodes_[i].load;
  return W;
}

DirectStiffness::Solution DirectStiffness::Solve() const {
  const SemidefiniteSolver solver(Aggregate());
  return {solver.Solve(Load()), solver.rank(), num_coordinates_};  // (5)
}

DirectStiffness::Stiffness DirectStiffness::CartesianStiffness(int node) const {
  // All q with T q = Δt are q = T⁺ Δt + Z y; the y of least energy gives the Schur complement below.
  constexpr double kIndependent = 1e-10;
  const Eigen::MatrixXd T = Map(node), K = Aggregate();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(T.transpose() * T);
  const Eigen::ArrayXd squares = eigen.eigenvalues();  // ascending
  const auto dependent = (squares <= kIndependent * squares.maxCoeff()).count();
  const auto rank_T = num_coordinates_ - dependent;
  const Eigen::MatrixXd Z = eigen.eigenvectors().leftCols(dependent);
  const Eigen::MatrixXd V = eigen.eigenvectors().rightCols(rank_T);
  const Eigen::MatrixXd T_plus =
      V * squares.tail(rank_T).inverse().matrix().asDiagonal() * V.transpose() * T.transpose();
  const Eigen::MatrixXd KZ = K * Z;
  Eigen::MatrixXd schur = K * T_plus;
  if (dependent > 0) schur -= KZ * SemidefiniteSolver(Z.transpose() * KZ).Solve(KZ.transpose() * T_plus);
  const Eigen::MatrixXd K_node = T_plus.transpose() * schur;
  Stiffness out;
  out.K = 0.5 * (K_node + K_node.transpose());
  out.rank = SemidefiniteSolver(out.K).rank();
  return out;
}

}  // namespace reed::model
