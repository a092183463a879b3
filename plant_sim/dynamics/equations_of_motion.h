// Lagrange's equations (19)-(21) of the whole chain, solved in one sweep to the base and one to the tip.
//
//   M(x) x'' + h(x, x') + ∂E_p/∂x + D x' = Q + J_toolᵀ F_in      (21), x = [θ | q | e of every member]
//
// The tree structure of M is used and M is never built: each element passes to its carrier the 6x6 inertia
// and the wrench that are left once its own coordinates are eliminated, so one solution costs O(elements). A
// linearly implicit integrator needs more than x'': it needs the rate k of
//   (M + c_d D + c_k K) k = F(x, x') + D y_d - K y_k
// with K = ∂²E_p/∂x² of springs, beams and contact, D = -∂F/∂x' of damping, friction and contact.
// c_d = c_k = 0 gives x'' itself. RT: safe after construction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reed/plant/dynamics/arm_chain.h"
#include "reed/plant/dynamics/brake.h"
#include "reed/plant/dynamics/elimination.h"
#include "reed/plant/dynamics/wall.h"

namespace reed::plant {

/// What acts on the arm from outside at one instant.
struct Load {
  Eigen::VectorXd motor_torque;                           // N·m
  const std::vector<Brake>* brakes = nullptr;             // null: open
  bool hold_motors = false;                               // the motors cannot move at all
  Eigen::Vector3d disturbance = Eigen::Vector3d::Zero();  // N, at the tool point, world frame
};

/// Right-hand side terms and weights of the implicit part, as defined above.
struct Implicit {
  double c_d = 0.0, c_k = 0.0;
  Eigen::VectorXd y_d, y_k;
  Eigen::Vector3d tool_y_d = Eigen::Vector3d::Zero(),
                  tool_y_k = Eigen::Vector3d::Zero();  // J_tool y, world frame
};

class EquationsOfMotion {
 public:
  /// Keeps references: the chain's damping may be changed between two calls of Solve.
  EquationsOfMotion(const ArmChain& chain, const Wall& wall);

  int dof() const { return n_; }
  int size() const { return chain_.num_coordinates(); }

  /// Kinematics of this state; everything below refers to it.
  void SetState(const Eigen::VectorXd& x, const Eigen::VectorXd& x_dot);

  /// Point mass at the tool point in addition to the chain's bodies.
  void SetPayload(double mass_kg);

  /// k as defined above.
  void Solve(const Load& load, const Implicit& implicit, Eigen::VectorXd& k);

  /// J_tool k of the last Solve, world frame.
  const Eigen::Vector3d& tool_rate() const { return tool_rate_; }

  const Eigen::Vector3d& tool_position() const { return tool_position_; }
  const Eigen::Vector3d& tool_velocity() const { return tool_velocity_; }
  const Wall::Contact& contact() const { return contact_; }

  /// The last output frame in the world, and the velocity of a point fixed to it, world frame.
  const Placement& last_frame() const { return nodes_.back().world; }
  Eigen::Vector3d VelocityOf(const Eigen::Vector3d& point) const {
    const Node& last = nodes_.back();
    return last.world.R * (last.motion.velocity + last.motion.omega.cross(point));
  }

  double KineticEnergy() const;  // (17) and 1/2 J_m θ'²
  double GravityEnergy() const;  // E_p1, zero with every mass at the base origin
  double ElasticEnergy() const;  // E_p2 + E_p3

  /// Dense M(x) and ∂(tool point)/∂x, for modes and checks. Set-up only.
  Eigen::MatrixXd MassMatrix() const;
  Eigen::MatrixXd ToolJacobian() const;
  /// ∂²(E_p2 + E_p3)/∂x²: springs and beams. Set-up only.
  Eigen::MatrixXd StiffnessMatrix() const;

 private:
  struct Node {       // one per element
    Placement pose;   // output frame in the carrier's output frame
    Placement world;  // output frame in the base
    Motion motion;    // of the output frame
    RigidBody body;   // payload included
    Inertia6 body_inertia;
    bool loaded = false;  // whether there is a body at all
  };
  struct JointWork {  // eliminated: the motor angle, then the joint angle
    Eigen::Vector3d U_linear, U_angular;
    double pivot = 1.0, rest = 0.0;
    double motor_pivot = 1.0, motor_rest = 0.0, coupling = 0.0;
  };
  struct MemberWork {  // eliminated: the elastic coordinates
    BeamInertia inertia;
    Section tip, body_section;
    Motion base;
    ElasticVec e = ElasticVec::Zero(), e_dot = ElasticVec::Zero();
    ElementBlock block;
  };

  void MoveJoint(const Element& element, const Motion& carrier, Node& node);
  void MoveMember(const Element& element, const Motion& carrier, Node& node);
  void EliminateMotor(int joint, const Load& load, const Implicit& implicit, double& torque, double& inertia);
  void EliminateJoint(int joint, const Load& load, const Implicit& implicit, Inertia6& I, Wrench& p);
  void EliminateMember(int member, const Implicit& implicit, Inertia6& I, Wrench& p);
  Eigen::Index ElasticIndex(int member) const { return 2 * n_ + kElastic * member; }

  const ArmChain& chain_;
  const Wall& wall_;
  int n_;
  Eigen::VectorXd x_, x_dot_;
  std::vector<Node> nodes_;
  std::vector<JointWork> joints_;
  std::vector<MemberWork> members_;
  Eigen::Vector3d tool_position_, tool_velocity_, tool_rate_ = Eigen::Vector3d::Zero();
  Wall::Contact contact_;
};

}  // namespace reed::plant
