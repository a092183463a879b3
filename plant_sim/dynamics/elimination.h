// One element's share of the sweep: the quadratic form in [e | base rate] and the elimination of e. RT: safe.
#pragma once

#include "plant_sim/dynamics/beam_inertia.h"

namespace reed::plant {

/// Equations  M [k_e; k_base] + p = 0  of one element, its own and everything it carries.
class ElementBlock {
 public:
  void Set(const BlockMat& M, const BlockVec& p) {
    M_ = M;
    p_ = p;
  }

  /// A body at a section: `inertia` and `force` in the axes of the element's base, about the section's
  /// origin.
  void Carry(const Section& section, const Inertia6& inertia, const Wrench& force);

  /// Stiffness and damping of the element's own coordinates, and the force they exert.
  void AddElastic(const ElasticMat& M, const ElasticVec& force) {
    M_.topLeftCorner<kElastic, kElastic>() += M;
    p_.head<kElastic>() -= force;
  }

  /// Eliminates e. What is left is what the carrier feels.
  void Eliminate(Inertia6& inertia, Wrench& force);

  /// k_e for a given rate of the base; after Eliminate.
  void BackSubstitute(const Rate& base, Eigen::Ref<Eigen::VectorXd> k_e) const;

 private:
  BlockMat M_;
  BlockVec p_;
  ElasticVec pivot_inverse_;
};

}  // namespace reed::plant
