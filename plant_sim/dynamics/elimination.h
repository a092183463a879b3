// One element's share of the sweep: the quadratic form in [e | base rate] and the elimination of e. RT: safe.
#pragma once

#include <algorithm>

#include "reed/plant/dynamics/beam_elasticity.h"
#include "reed/plant/dynamics/beam_inertia.h"

namespace reed::plant {

/// Equations  M [k_e; k_base] + p = 0  of one element, its own and everything it carries. Of M only the upper
/// triangle is kept up.
class ElementBlock {
 public:
  void Set(const BlockMat& M, const BlockVec& p) {
    std::copy_n(M.data(), M.size(), M_.data());  // at once: Eigen would go number by number
    p_ = p;
  }

  /// A body at a section: `inertia` and `force` in the axes of the element's base, about the section's
  /// origin.
  void Carry(const Section& section, const Inertia6& inertia, const Wrench& force);

  /// weight * K, and the force K * reach.
  void AddElastic(const BeamElasticity& elasticity, double weight, const ElasticVec& reach);

  /// Eliminates e. The rest acts on the carrier.
  void Eliminate(Inertia6& inertia, Wrench& force);

  /// [k_e; k_base] for a given rate of the base; after Eliminate.
  BlockVec BackSubstitute(const Rate& base) const;

 private:
  BlockMat M_ = BlockMat::Zero();
  BlockVec p_ = BlockVec::Zero();
  ElasticVec pivot_inverse_ = ElasticVec::Zero();
};

}  // namespace reed::plant
