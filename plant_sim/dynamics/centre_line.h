// The arm's centre line as points from base to tool point, world frame: every joint, both ends of every element and
// sections inside it. What is rigid between them is a straight line. Kinematics alone, so that it can be asked for any
// state beside the one that is integrated. RT: safe after construction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reed/plant/dynamics/arm_chain.h"
#include "reed/plant/dynamics/section.h"

namespace reed::plant {

class CentreLine {
 public:
  /// `samples` sections inside each element, equally spaced. Keeps a reference to the chain.
  CentreLine(const ArmChain& chain, int samples);

  /// Points for the state x = [θ | q | e of every member]; valid until the next call.
  const std::vector<Eigen::Vector3d>& At(const Eigen::VectorXd& x);

 private:
  /// A member that does not begin where the element before it ends.
  static bool StartsApart(const Element& element);

  const ArmChain& chain_;
  std::size_t samples_;
  std::vector<Section> sections_;  // of each member: those inside, then its end
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace reed::plant
