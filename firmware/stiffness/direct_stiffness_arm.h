// The arm as nodes, joints and members of the direct stiffness method (5), (6). RT: set-up only (allocates).
#pragma once

#include <vector>

#include "reed/core/model/compliance.h"
#include "reed/firmware/stiffness/direct_stiffness.h"

namespace reed::model {

struct ArmStructure {
  DirectStiffness matrix;
  std::vector<int>
      joints;  // one node per joint: the start of its link; empty joint rotations when joints are rigid
  std::vector<int> members;  // end node of every member, from base to tip
  int tip = 0;               // tool point
};

/// The structure at the state of `kin`, under `loads`, clamped at the base.
template <int N, int P>
ArmStructure StructureOf(const ArmModel<N, P>& arm, const Kinematics<N>& kin, const StructuralLoads<N>& loads,
                         JointModel joint_model) {
  ArmStructure out;
  DirectStiffness& matrix = out.matrix;
  const auto wrench = [](const Wrench& W) {
    Vec6 both;
    both << W.F, W.n;
    return both;
  };
  int end = matrix.AddSupport(Eigen::Vector3d::Zero());
  int j = 0;
  for (int i = 0; i < N; ++i) {
    const Eigen::Vector3d start = kin.p[i] - arm.d(i) * kin.R[i].col(2);
    const double k_q = arm.joint_stiffness(i);
    const bool elastic = joint_model == JointModel::kElastic && std::isfinite(k_q);
    end = elastic ? matrix.AddJoint(end, start, kin.R[i].col(2), k_q) : matrix.AddRigid(end, start);
    out.joints.push_back(end);
    if (arm.carrier[i] < 0) {
      end = matrix.AddRigid(end, kin.p[i]);
      matrix.AddLoad(end, wrench(loads.rigid_link[i]));
    }
    for (; j < arm.num_members && arm.member[j].link == i; ++j) {
      const Member& beam = arm.member[j];
      const MemberLoad& load = loads.member[j];
      const MemberLine line = LineOf(beam, kin.R[i], kin.p[i]);
      const int from = matrix.AddRigid(end, line.start);
      end = matrix.AddFree(line.end);
      matrix.AddMember(from, end, {beam.EA, beam.EI_y, beam.EI_z, beam.GJ}, kin.R[i] * beam.y, load.spread);
      matrix.AddLoad(from, wrench({load.start, Eigen::Vector3d::Zero()}));
      matrix.AddLoad(end, wrench(load.end));
      out.members.push_back(end);
    }
  }
  out.tip = matrix.AddRigid(end, kin.tip);
  matrix.AddLoad(out.tip, wrench(loads.tip));
  return out;
}

}  // namespace reed::model
