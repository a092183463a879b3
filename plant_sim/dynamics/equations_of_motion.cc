#include "plant_sim/dynamics/equations_of_motion.h"

#include <cmath>

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kImmovable = 1e300;  // kg·m²

Matrix3d TurnZ(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

}  // namespace

EquationsOfMotion::EquationsOfMotion(const ArmChain& chain, const Wall& wall)
    : chain_(chain), wall_(wall), n_(chain.dof()), nodes_(chain.elements.size()) {
  x_ = x_dot_ = VectorXd::Zero(size());
  SetPayload(0.0);
}

void EquationsOfMotion::SetPayload(double mass_kg) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].body = chain_.elements[i].body;
  nodes_.back().body = Join(nodes_.back().body, {mass_kg, chain_.tool.p, Matrix3d::Zero()});
}

void EquationsOfMotion::SetState(const VectorXd& x, const VectorXd& x_dot) {
  x_ = x;
  x_dot_ = x_dot;
  Placement carrier_world;
  Motion carrier;
  carrier.bias_linear = -chain_.gravity;  // gravity is an upward acceleration of the base
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const auto joint = static_cast<Eigen::Index>(i);
    const double speed = x_dot_[n_ + joint];
    const Placement& mount = chain_.elements[i].mount;
    node.pose = {mount.R * TurnZ(x_[n_ + joint]), mount.p};
    node.world = carrier_world * node.pose;
    node.motion = Carried(carrier, node.pose);
    node.motion.bias_angular += node.motion.omega.cross(Vector3d(0.0, 0.0, speed));
    node.motion.omega.z() += speed;
    carrier = node.motion;
    carrier_world = node.world;
  }
  tool_world_ = carrier_world * chain_.tool;
  tool_position_ = tool_world_.p;
  tool_velocity_ = carrier_world.R * (carrier.velocity + carrier.omega.cross(chain_.tool.p));
  contact_ = wall_.Touch(tool_position_, tool_velocity_);
}

void EquationsOfMotion::EliminateMotor(std::size_t i, const Load& load, const Implicit& implicit,
                                       double& torque, double& inertia) {
  Node& node = nodes_[i];
  const Drivetrain& drive = chain_.drivetrains[i];
  const auto m = static_cast<Eigen::Index>(i), j = m + n_;
  const double angle = x_[m], speed = x_dot_[m];
  const double xi = angle - x_[j], xi_dot = speed - x_dot_[j];
  const double k = drive.spring.TangentStiffness(xi), d = drive.spring.d, f = drive.friction.Chord(speed);
  const double tau_s = drive.spring.Torque(xi, xi_dot);
  const double implicit_s = d * (implicit.y_d[m] - implicit.y_d[j]) - k * (implicit.y_k[m] - implicit.y_k[j]);
  node.coupling = implicit.c_d * d + implicit.c_k * k;
  if (load.hold_motors) {
    node.motor_rest = 0.0;
    node.motor_pivot = kImmovable;
    torque = tau_s - implicit_s;
    inertia = node.coupling;
    return;
  }

  double motor =
      load.motor_torque[m] - drive.friction.Torque(speed) - tau_s + f * implicit.y_d[m] + implicit_s;
  node.motor_pivot = drive.rotor_inertia + implicit.c_d * f + node.coupling;
  if (load.brakes != nullptr) {
    const Brake& brake = (*load.brakes)[i];
    motor +=
        brake.Torque(angle, speed) + brake.damping() * implicit.y_d[m] - brake.stiffness() * implicit.y_k[m];
    node.motor_pivot += implicit.c_d * brake.damping() + implicit.c_k * brake.stiffness();
  }
  node.motor_rest = motor;
  // Schur complement of the motor row [pivot, -coupling | rest] in the joint's.
  torque = tau_s - implicit_s + node.coupling * motor / node.motor_pivot;
  inertia = node.coupling * (node.motor_pivot - node.coupling) / node.motor_pivot;
}

void EquationsOfMotion::Solve(const Load& load, const Implicit& implicit, VectorXd& k) {
  // Tool point: contact and disturbance in the axes of the last frame.
  const std::size_t last = nodes_.size() - 1;
  const Matrix3d& R = nodes_[last].world.R;
  const Vector3d tool_force = contact_.force + load.disturbance + contact_.damping * implicit.tool_y_d -
                              contact_.stiffness * implicit.tool_y_k;
  Inertia6 tool;
  tool.A = R.transpose() * (implicit.c_d * contact_.damping + implicit.c_k * contact_.stiffness) * R;
  Inertia6 from_child = InParent(Placement{Matrix3d::Identity(), chain_.tool.p}, tool);
  Wrench force_from_child = InParent(Placement{Matrix3d::Identity(), chain_.tool.p},
                                     Wrench{-R.transpose() * tool_force, Vector3d::Zero()});

  for (std::size_t i = nodes_.size(); i-- > 0;) {  // tip to base
    Node& node = nodes_[i];
    Inertia6 I = node.body.AtOrigin();
    I += from_child;
    Wrench p = node.body.Bias(node.motion);
    p.force += force_from_child.force;
    p.moment += force_from_child.moment;

    double torque = 0.0, inertia = 0.0;
    EliminateMotor(i, load, implicit, torque, inertia);
    node.U_linear = I.B.col(2);
    node.U_angular = I.D.col(2);
    node.pivot = node.U_angular.z() + inertia;
    node.rest = torque - p.moment.z();
    const Vector3d ul = node.U_linear / node.pivot, ua = node.U_angular / node.pivot;
    I.A -= node.U_linear * ul.transpose();
    I.B -= node.U_linear * ua.transpose();
    I.D -= node.U_angular * ua.transpose();
    p.force += ul * node.rest;
    p.moment += ua * node.rest;
    from_child = InParent(node.pose, I);
    force_from_child = InParent(node.pose, p);
  }

  Rate carrier;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {  // base to tip
    const Node& node = nodes_[i];
    const auto m = static_cast<Eigen::Index>(i), j = m + n_;
    Rate rate = Carried(carrier, node.pose);
    k[j] = (node.rest - node.U_linear.dot(rate.linear) - node.U_angular.dot(rate.angular)) / node.pivot;
    k[m] = (node.motor_rest + node.coupling * k[j]) / node.motor_pivot;
    rate.angular.z() += k[j];
    carrier = rate;
  }
  tool_rate_ = R * (carrier.linear + carrier.angular.cross(chain_.tool.p));
}

double EquationsOfMotion::KineticEnergy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double speed = x_dot_[static_cast<Eigen::Index>(i)];
    energy += nodes_[i].body.KineticEnergy(nodes_[i].motion) +
              0.5 * chain_.drivetrains[i].rotor_inertia * speed * speed;
  }
  return energy;
}

double EquationsOfMotion::GravityEnergy() const {
  double energy = 0.0;
  for (const Node& node : nodes_) energy -= node.body.mass * chain_.gravity.dot(node.world * node.body.com);
  return energy;
}

double EquationsOfMotion::ElasticEnergy() const {
  double energy = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i)
    energy += chain_.drivetrains[static_cast<std::size_t>(i)].spring.Energy(x_[i] - x_[n_ + i]);
  return energy;
}

}  // namespace reed::plant
