// Direct stiffness method (4)-(6), the paper's finite matrix analysis: nodes, the conditions between them, members,
// loads. All nodal displacements at once.
//
// Each condition of (6) makes a node out of another one, so that the conditions hold by construction and the
// unknowns are only the coordinates that remain:
//   support         Δt = 0
//   free            Δt: six coordinates
//   rigid           Ω^r (Δt_i - Δt_j) = 0: moves with its master like one body, no coordinate
//   elastic joint   as rigid, but for one rotation: Ω^e (Δt_i - Δt_j) = ξ, one coordinate, Ω^e W = k_q ξ
// With Δt = T q the aggregate of (5) is  (Tᵀ K T) q = Tᵀ W.  World axes, SI.  RT: set-up only (allocates).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reed/firmware/stiffness/member_stiffness.h"

namespace reed::model {

class DirectStiffness {
 public:
  /// Rank of a solution: below full rank something can move freely and the answer is the least-norm
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

  /// Throws std::invalid_argument when the nodes coincide. y: axis of the section, across the member; `spread_force`:
  /// total force, spread evenly.
  void AddMember(int from, int to, const SectionStiffness& section, const Eigen::Vector3d& y,
                 const Eigen::Vector3d& spread_force);
  /// Of a round section.
  void AddMember(int from, int to, double EA, double EI, double GJ, const Eigen::Vector3d& spread_force);

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
  Eigen::Vector3d Between(int from, int to) const;

  int AddNode(const Eigen::Vector3d& position, int master, int coordinates);

  /// Rows of T that belong to a node.
  Eigen::MatrixXd Map(int node) const;
  Eigen::MatrixXd Aggregate() const;
  Eigen::VectorXd Load() const;

  std::vector<Node> nodes_;
  std::vector<Beam> members_;
  int num_coordinates_ = 0;
};

}  // namespace reed::model
