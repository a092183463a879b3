// Knots of a planned motion with their owner; the controller reads them through a view. RT: set-up only.
#pragma once

#include <vector>

#include "reed/core/reference/joint_path.h"

namespace reed::reference {

template <int N>
struct PlannedPath {
  std::vector<typename JointPath<N>::Knot> knots;
  double spacing_s = 0.0;

  JointPath<N> View() const noexcept { return {knots, spacing_s}; }
};

}  // namespace reed::reference
