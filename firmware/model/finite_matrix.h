// Finite matrix analysis (4)-(6): nodes, the conditions between them, members, loads; all nodal displacements
// at once.
//
// Each condition of (6) makes a node out of another one, so that the conditions hold by construction and the
// unknowns are only the coordinates that remain:
//   support         Δt = 0
//   free            Δt: six coordinates
//   rigid           Ω^r (Δt_i - Δt_j) = 0: moves with its master like one body, no coordinate
//   elastic joint   as rigid, but for one rotation: Ω^e (Δt_i - Δt_j) = ξ, one coordinate, Ω^e W = k_q ξ
// With Δt = T q the aggregate of (5) is  (Tᵀ K T) q = Tᵀ W.  Base axes, SI.  RT: set-up only (allocates).
#pragma once

#include <Eigen/Dense>
#include <stdexcept>
#include <vector>

#include "firmware/model/member_stiffness.h"

namespace reed::model {

class FiniteMatrix {
 public:
  /// What a solution is worth: below full rank something can move freely and the answer is the least-norm
  /// one.
  struct Solution {
    Eigen::VectorXd q;
    int rank = 0;
    int coordinates = 0;
    bool determinate() const { return rank == coordinates; }
  };

  struct Stiffness {
    Mat6 K = Mat6::Zero();
    int rank = 0;
  };

  int AddSupport(const Eigen::Vector3d& position) { return AddNode(position, kNone, 0); }
  int AddFree(const Eigen::Vector3d& position) { return AddNode(position, kNone, 6); }
  int AddRigid(int master, const Eigen::Vector3d& position) { return AddNode(position, master, 0); }

  /// k_q = 0: a joint that passes no moment about its axis.
  int AddJoint(int master, const Eigen::Vector3d& position, const Eigen::Vector3d& axis, double k_q) {
    const int id = AddNode(position, master, 1);
    Node& node = nodes_[Index(id)];
    node.axis = axis;
    node.k_q = k_q;
    return id;
  }

  void AddMember(int from, int to, double EA, double EI, double GJ, const Eigen::Vector3d& spread_force) {
    const Eigen::Vector3d r = nodes_.at(Index(to)).position - nodes_.at(Index(from)).position;
    const double L = r.norm();
    if (!(L > 0.0)) throw std::invalid_argument("a member needs two nodes apart");
    members_.push_back(
        {from, to, MemberStiffness(r / L, L, EA, EI, GJ), EquivalentNodalLoad(r / L, L, spread_force)});
  }

  /// Force and moment on a node, moment about it.
  void AddLoad(int node, const Vec6& wrench) { nodes_.at(Index(node)).load += wrench; }

  Solution Solve() const;

  /// Δt of a node for a solution.
  Vec6 Displacement(int node, const Solution& solution) const { return Map(node) * solution.q; }

  /// ξ of a joint node.
  double JointRotation(int node, const Solution& solution) const {
    return solution.q(nodes_.at(Index(node)).first);
  }

  /// (4) W = K Δt at one node with nothing else loaded: Δt prescribed, all other coordinates relaxed. Joints
  /// that pass no moment make it rank-deficient, which is reported and no error.
  Stiffness CartesianStiffness(int node) const;

 private:
  static constexpr int kNone = -1;
  struct Node {
    Eigen::Vector3d position;
    int master;
    int first;        // its first coordinate
    int coordinates;  // 0, 1 or 6
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    double k_q = 0.0;
    Vec6 load = Vec6::Zero();
  };
  struct Beam {
    int from, to;
    Mat12 K;
    Vec12 load;
  };

  static std::size_t Index(int id) { return static_cast<std::size_t>(id); }

  int AddNode(const Eigen::Vector3d& position, int master, int coordinates) {
    if (master != kNone && Index(master) >= nodes_.size()) throw std::invalid_argument("no such master node");
    nodes_.push_back({position, master, num_coordinates_, coordinates});
    num_coordinates_ += coordinates;
    return static_cast<int>(nodes_.size()) - 1;
  }

  /// Rows of T that belong to a node.
  Eigen::MatrixXd Map(int node) const;
  Eigen::MatrixXd Aggregate() const;
  Eigen::VectorXd Load() const;

  std::vector<Node> nodes_;
  std::vector<Beam> members_;
  int num_coordinates_ = 0;
};

/// Symmetric positive semidefinite A x = b with unknowns of different units: scaled to a unit diagonal, rank
/// by eigenvalues, least norm (in the scaled unknowns) where the rank is not full.
struct SemidefiniteSolver {
  explicit SemidefiniteSolver(const Eigen::MatrixXd& A);
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& b) const;

  int rank = 0;

 private:
  Eigen::VectorXd scale_;
  Eigen::LDLT<Eigen::MatrixXd> ldlt_;
  Eigen::MatrixXd pseudo_inverse_;  // only below full rank
};

inline SemidefiniteSolver::SemidefiniteSolver(const Eigen::MatrixXd& A) {
  constexpr double kRankTolerance = 1e-11;  // relative to the largest eigenvalue of the scaled matrix
  const auto diagonal = A.diagonal().array();
  scale_ = (diagonal > 0.0).select(diagonal.sqrt().inverse(), 1.0).matrix();
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * A * scale_.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const auto& values = eigen.eigenvalues();
  const double smallest = A.rows() == 0 ? 0.0 : kRankTolerance * values.cwiseAbs().maxCoeff();
  rank = static_cast<int>((values.array() > smallest).count());
  if (rank == A.rows()) {
    ldlt_.compute(scaled);
    return;
  }
  const Eigen::VectorXd inverse = (values.array() > smallest).select(values.array().inverse(), 0.0);
  pseudo_inverse_ = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

inline Eigen::MatrixXd SemidefiniteSolver::Solve(const Eigen::MatrixXd& b) const {
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * b;
  if (rank == scale_.size()) return scale_.asDiagonal() * ldlt_.solve(scaled);
  return scale_.asDiagonal() * (pseudo_inverse_ * scaled);
}

inline Eigen::MatrixXd FiniteMatrix::Map(int id) const {
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

inline Eigen::MatrixXd FiniteMatrix::Aggregate() const {
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

inline Eigen::VectorXd FiniteMatrix::Load() const {
  Eigen::VectorXd W = Eigen::VectorXd::Zero(num_coordinates_);
  for (const Beam& beam : members_) {
    W += Map(beam.from).transpose() * beam.load.head<6>() + Map(beam.to).transpose() * beam.load.tail<6>();
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) W += Map(static_cast<int>(i)).transpose() * nodes_[i].load;
  return W;
}

inline FiniteMatrix::Solution FiniteMatrix::Solve() const {
  const SemidefiniteSolver solver(Aggregate());
  return {solver.Solve(Load()), solver.rank, num_coordinates_};  // (5)
}

inline FiniteMatrix::Stiffness FiniteMatrix::CartesianStiffness(int node) const {
  // All q with T q = Δt are q = T⁺ Δt + Z y; the y of least energy gives the Schur complement below.
  const Eigen::MatrixXd T = Map(node), K = Aggregate();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(T, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const auto rank_T = svd.rank();
  const Eigen::MatrixXd Z = svd.matrixV().rightCols(num_coordinates_ - rank_T);
  const Eigen::MatrixXd T_plus = svd.solve(Eigen::MatrixXd::Identity(6, 6));
  const Eigen::MatrixXd KZ = K * Z;
  Stiffness out;
  Eigen::MatrixXd schur = K * T_plus;
  if (Z.cols() > 0) schur -= KZ * SemidefiniteSolver(Z.transpose() * KZ).Solve(KZ.transpose() * T_plus);
  out.K = T_plus.transpose() * schur;
  out.K = (0.5 * (out.K + out.K.transpose())).eval();
  out.rank = SemidefiniteSolver(out.K).rank;
  return out;
}

}  // namespace reed::model
