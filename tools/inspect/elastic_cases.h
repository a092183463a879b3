// Compliance and static deflection (4)-(6), (22) of a case. RT: set-up only.
#pragma once

#include "reed/core/model/static_deflection.h"
#include "reed/firmware/stiffness/direct_stiffness_arm.h"
#include "reed/firmware/stiffness/semidefinite_solver.h"
#include "reed/inspect/rigid_cases.h"

namespace reed::inspect {

/// q → compliance of the tool point, rows and columns linear then angular.
template <int N>
void PutCompliance(const Arm<N>& arm, const model::Kinematics<N>& kin, NamedValues& out) {
  const bool springs = arm.joint_stiffness.allFinite(), members = arm.num_members > 0;
  const model::Mat6 C_joints = model::JointCompliance(arm, kin), C_links = model::LinkCompliance(arm, kin);
  if (springs) {
    out.SetMatrix("C_joints", C_joints);
    out.SetScalar("rank_C_joints", model::SemidefiniteSolver(C_joints).rank());
  }
  if (members) out.SetMatrix("C_links", C_links);
  if (!springs || !members) return;
  const model::Mat6 C_total = C_joints + C_links;
  out.SetMatrix("C_total", C_total);
  const model::StructuralLoads<N> none;
  const model::ArmStructure structure = model::StructureOf(arm, kin, none, model::JointModel::kElastic);
  const auto cartesian = structure.matrix.CartesianStiffness(structure.tip);
  out.SetMatrix("K_total", cartesian.K);
  out.SetScalar("rank_K_total", cartesian.rank);
}

/// Δt of the end node of every member: from the serial form, and under name_by_matrix from the aggregated
/// system (5). For short stiff members the serial form is the exact one: (5) loses a digit with each power of
/// ten in stiffness.
template <int N>
void PutNodes(const std::string& name, const Arm<N>& arm, const model::Kinematics<N>& kin,
              const model::StructuralLoads<N>& loads, model::JointModel joints, NamedValues& out) {
  if (arm.num_members == 0) return;
  const auto node = model::NodeDeflections(arm, kin, model::DeflectSerially(arm, kin, loads), joints);
  const model::ArmStructure structure = model::StructureOf(arm, kin, loads, joints);
  const auto solution = structure.matrix.Solve();
  Eigen::MatrixXd serial(arm.num_members, 6), by_matrix(arm.num_members, 6);
  for (int j = 0; j < arm.num_members; ++j) {
    serial.row(j) = node[j].AsVector();
    by_matrix.row(j) =
        structure.matrix.Displacement(structure.members[static_cast<std::size_t>(j)], solution);
  }
  out.SetMatrix(name, serial);
  out.SetMatrix(name + "_by_matrix", by_matrix);
}

/// q wrench_world_tip → deflections of tip and nodes under it, and with the self-weight ρA g of the members
/// added.
template <int N>
void PutDeflections(const Arm<N>& arm, const model::Kinematics<N>& kin, const NamedValues& in,
                    NamedValues& out) {
  const model::Vec6 W = in.Vector<6>("wrench_world_tip");
  model::StructuralLoads<N> loads;
  loads.tip = {W.head<3>(), W.tail<3>()};
  const auto bent = model::DeflectSerially(arm, kin, loads);
  const model::Vec6 links = bent.tip_links.AsVector();
  out.SetVector("tip_deflection_rigid_joints", links);
  PutNodes("node_deflections_rigid_joints", arm, kin, loads, model::JointModel::kRigid, out);
  if (arm.joint_stiffness.allFinite()) {
    const model::Vec6 with_springs = links + model::TipBySprings(kin, bent).AsVector();
    out.SetVector("tip_deflection_with_joint_springs", with_springs);
    PutNodes("node_deflections_with_joint_springs", arm, kin, loads, model::JointModel::kElastic, out);
  }
  model::AddSelfWeight(arm, loads);
  out.SetVector("tip_deflection_rigid_joints_self_weight",
                model::DeflectSerially(arm, kin, loads).tip_links.AsVector());
  PutNodes("node_deflections_self_weight", arm, kin, loads, model::JointModel::kRigid, out);
}

/// q → what the weight of the bodies (parameters at their truth) does to the arm, and (22) what the motors do
/// about it.
template <int N>
void PutSag(const Arm<N>& arm, const model::Kinematics<N>& kin, NamedValues& out) {
  const model::Bodies<N> bodies = model::BodiesFor(arm, arm.p_true);
  model::StructuralLoads<N> loads;
  model::AddBodyWeight(arm, kin, bodies, loads);
  const auto bent = model::DeflectSerially(arm, kin, loads);
  const model::Vec6 sag = bent.tip_links.AsVector() + model::TipBySprings(kin, bent).AsVector();
  out.SetVector("tip_sag", sag);
  PutNodes("node_sag", arm, kin, loads, model::JointModel::kElastic, out);
  out.SetVector("theta_d_offset", model::CompensateDeflection(arm, kin, bodies, model::Wrench{}).offset);
}

template <int N>
void InspectElastic(const Arm<N>& arm, const NamedValues& in, NamedValues& out) {
  model::Kinematics<N> kin;
  model::ForwardKinematics<N>(arm, in.Vector<N>("q"), model::Vec<N>::Zero(), kin);
  PutCompliance(arm, kin, out);
  if (arm.num_members == 0 && !arm.joint_stiffness.allFinite()) return;
  if (in.Has("wrench_world_tip")) PutDeflections(arm, kin, in, out);
  if (arm.joint_stiffness.allFinite()) PutSag(arm, kin, out);
}

}  // namespace reed::inspect
