#include "reed/plant/dynamics/equations_of_motion.h"

#include "reed/math/sine.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kImmovable = 1e300;  // kg·m²

}  // namespace

EquationsOfMotion::EquationsOfMotion(const ArmChain& chain, const Wall& wall)
    : chain_(chain),
      wall_(wall),
      n_(chain.dof()),
      nodes_(chain.elements.size()),
      joints_(chain.drivetrains.size()) {
  for (const Member& member : chain.members) {
    MemberWork work;
    work.inertia = member.inertia;
    work.tip = Section(member.length, member.length);
    if (member.body_at >= 0.0) work.body_section = Section(member.body_at, member.length);
    members_.push_back(work);
  }
  x_ = x_dot_ = VectorXd::Zero(size());
  SetPayload(0.0);
  SetState(VectorXd::Zero(size()), VectorXd::Zero(size()));
}

void EquationsOfMotion::SetPayload(double mass_kg) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].body = chain_.elements[i].body;
  nodes_.back().body = Join(nodes_.back().body, {mass_kg, chain_.tool.p, Matrix3d::Zero()});
  for (Node& node : nodes_) {
    node.body_inertia = node.body.AtOrigin();
    node.loaded = !node.body.empty();
  }
}

void EquationsOfMotion::SetState(const VectorXd& x, const VectorXd& x_dot) {
  x_ = x;
  x_dot_ = x_dot;
  Placement carrier_world;
  Motion carrier;
  carrier.bias_linear = -chain_.gravity;  // gravity is an upward acceleration of the base
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const Element& element = chain_.elements[i];
    if (element.joint >= 0)
      MoveJoint(element, carrier, node);
    else
      MoveMember(element, carrier, node);
    node.world = carrier_world * node.pose;
    carrier = node.motion;
    carrier_world = node.world;
  }
  tool_position_ = carrier_world * chain_.tool.p;
  tool_velocity_ = carrier_world.R * (carrier.velocity + carrier.omega.cross(chain_.tool.p));
  contact_ = wall_.Touch(tool_position_, tool_velocity_);
}

void EquationsOfMotion::MoveJoint(const Element& element, const Motion& carrier, Node& node) {
  const double speed = x_dot_[n_ + element.joint];
  const Matrix3d& mount = element.mount.R;
  const auto [s, c] = math::SinCos(x_[n_ + element.joint]);
  node.pose.R.col(0) = c * mount.col(0) + s * mount.col(1);
  node.pose.R.col(1) = c * mount.col(1) - s * mount.col(0);
  node.pose.R.col(2) = mount.col(2);
  node.pose.p = element.mount.p;
  node.motion = Carried(carrier, node.pose);
  node.motion.bias_angular += node.motion.omega.cross(Vector3d(0.0, 0.0, speed));
  node.motion.omega.z() += speed;
}

void EquationsOfMotion::MoveMember(const Element& element, const Motion& carrier, Node& node) {
  MemberWork& work = members_[static_cast<std::size_t>(element.member)];
  work.e = x_.segment<kElastic>(ElasticIndex(element.member));
  work.e_dot = x_dot_.segment<kElastic>(ElasticIndex(element.member));
  work.base = Carried(carrier, element.mount);
  work.inertia.Deform(work.e, work.e_dot);
  work.tip.Deform(work.e, work.e_dot);
  if (chain_.members[static_cast<std::size_t>(element.member)].body_at >= 0.0)
    work.body_section.Deform(work.e, work.e_dot);
  node.pose = element.mount * work.tip.pose();
  node.motion = work.tip.CarriedBy(work.base);
}

void EquationsOfMotion::EliminateMotor(int joint, const Load& load, const Implicit& implicit, double& torque,
                                       double& inertia) {
  JointWork& work = joints_[static_cast<std::size_t>(joint)];
  const Drivetrain& drive = chain_.drivetrains[static_cast<std::size_t>(joint)];
  const int m = joint, j = n_ + joint;
  const double angle = x_[m], speed = x_dot_[m];
  const double xi = angle - x_[j], xi_dot = speed - x_dot_[j];
  const double k = drive.spring.TangentStiffness(xi), d = drive.spring.d;
  const auto [friction_torque, f] = drive.friction.At(speed);
  const double tau_s = drive.spring.Torque(xi, xi_dot);
  const double implicit_s = d * (implicit.y_d[m] - implicit.y_d[j]) - k * (implicit.y_k[m] - implicit.y_k[j]);

  work.coupling = implicit.c_d * d + implicit.c_k * k;
  if (load.hold_motors) {
    work.motor_rest = 0.0;
    work.motor_pivot = kImmovable;
    torque = tau_s - implicit_s;
    inertia = work.coupling;
    return;
  }
  work.motor_rest = load.motor_torque[m] - friction_torque - tau_s + f * implicit.y_d[m] + implicit_s;
  work.motor_pivot = drive.rotor_inertia + implicit.c_d * f + work.coupling;
  if (load.brakes != nullptr) {
    const Brake& brake = (*load.brakes)[static_cast<std::size_t>(joint)];
    work.motor_rest +=
        brake.Torque(angle, speed) + brake.damping() * implicit.y_d[m] - brake.stiffness() * implicit.y_k[m];
    work.motor_pivot += implicit.c_d * brake.damping() + implicit.c_k * brake.stiffness();
  }
  // Schur complement of the motor row [pivot, -coupling | rest] in the joint's.
  torque = tau_s - implicit_s + work.coupling * work.motor_rest / work.motor_pivot;
  inertia = work.coupling * (work.motor_pivot - work.coupling) / work.motor_pivot;
}

void EquationsOfMotion::EliminateJoint(int joint, const Load& load, const Implicit& implicit, Inertia6& I,
                                       Wrench& p) {
  double torque = 0.0, inertia = 0.0;
  EliminateMotor(joint, load, implicit, torque, inertia);
  JointWork& work = joints_[static_cast<std::size_t>(joint)];
  work.U_linear = I.B.col(2);
  work.U_angular = I.D.col(2);
  work.pivot = work.U_angular.z() + inertia;
  work.rest = torque - p.moment.z();
  const Vector3d ul = work.U_linear / work.pivot, ua = work.U_angular / work.pivot;
  I.A -= work.U_linear * ul.transpose();
  I.B -= work.U_linear * ua.transpose();
  I.D -= work.U_angular * ua.transpose();
  p.force += ul * work.rest;
  p.moment += ua * work.rest;
}

void EquationsOfMotion::EliminateMember(int member, const Implicit& implicit, Inertia6& I, Wrench& p) {
  MemberWork& work = members_[static_cast<std::size_t>(member)];
  const Member& beam = chain_.members[static_cast<std::size_t>(member)];
  const Eigen::Index at = ElasticIndex(member);

  work.block.Set(work.inertia.mass_matrix(), work.inertia.Bias(work.base));
  const Matrix3d& Q = work.tip.pose().R;
  work.block.Carry(work.tip, Turned(Q, I), {Q * p.force, Q * p.moment});
  if (beam.body_at >= 0.0) {
    const Placement turn{work.body_section.pose().R, Vector3d::Zero()};
    const Wrench force = beam.body.Bias(work.body_section.CarriedBy(work.base));
    work.block.Carry(work.body_section, InParent(turn, beam.body).AtOrigin(), InParent(turn, force));
  }

  const double beta = beam.elasticity.beta;
  const ElasticVec reach =
      beta * (implicit.y_d.segment<kElastic>(at) - work.e_dot) - work.e - implicit.y_k.segment<kElastic>(at);
  work.block.AddElastic(beam.elasticity, implicit.c_k + beta * implicit.c_d, reach);
  work.block.Eliminate(I, p);
}

void EquationsOfMotion::Solve(const Load& load, const Implicit& implicit, VectorXd& k) {
  // Tool point: contact and disturbance in the axes of the last output frame.
  const Matrix3d& R = nodes_.back().world.R;
  const Vector3d tool_force = contact_.force + load.disturbance + contact_.damping * implicit.tool_y_d -
                              contact_.stiffness * implicit.tool_y_k;
  Inertia6 I;
  I.A = R.transpose() * (implicit.c_d * contact_.damping + implicit.c_k * contact_.stiffness) * R;
  I = InParent(Placement{Matrix3d::Identity(), chain_.tool.p}, I);
  Wrench p = InParent(Placement{Matrix3d::Identity(), chain_.tool.p},
                      Wrench{-R.transpose() * tool_force, Vector3d::Zero()});

  for (std::size_t i = nodes_.size(); i-- > 0;) {  // tip to base
    const Node& node = nodes_[i];
    const Element& element = chain_.elements[i];
    if (node.loaded) {
      const Wrench own = node.body.Bias(node.motion);
      I += node.body_inertia;
      p.force += own.force;
      p.moment += own.moment;
    }
    if (element.joint >= 0)
      EliminateJoint(element.joint, load, implicit, I, p);
    else
      EliminateMember(element.member, implicit, I, p);
    const Placement& pose = element.joint >= 0 ? node.pose : element.mount;
    if (element.joint >= 0 || element.mount_turns) I = Turned(pose.R, I);
    if (element.mount_shifts) I = Shifted(pose.p, I);
    p = InParent(pose, p);
  }

  Rate carrier;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {  // base to tip
    const Element& element = chain_.elements[i];
    if (element.joint >= 0) {
      const JointWork& work = joints_[static_cast<std::size_t>(element.joint)];
      Rate rate = Carried(carrier, nodes_[i].pose);
      const double kq =
          (work.rest - work.U_linear.dot(rate.linear) - work.U_angular.dot(rate.angular)) / work.pivot;
      k[n_ + element.joint] = kq;
      k[element.joint] = (work.motor_rest + work.coupling * kq) / work.motor_pivot;
      rate.angular.z() += kq;
      carrier = rate;
    } else {
      const MemberWork& work = members_[static_cast<std::size_t>(element.member)];
      const Rate base = Carried(carrier, element.mount);
      const BlockVec rate = work.block.BackSubstitute(base);
      k.segment<kElastic>(ElasticIndex(element.member)) = rate.head<kElastic>();
      carrier = work.tip.CarriedBy(rate);
    }
  }
  tool_rate_ = R * (carrier.linear + carrier.angular.cross(chain_.tool.p));
}

double EquationsOfMotion::KineticEnergy() const {
  double energy = 0.0;
  for (int i = 0; i < n_; ++i)
    energy += 0.5 * chain_.drivetrains[static_cast<std::size_t>(i)].rotor_inertia * x_dot_[i] * x_dot_[i];
  for (const Node& node : nodes_) energy += node.body.KineticEnergy(node.motion);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const MemberWork& work = members_[i];
    energy += work.inertia.KineticEnergy(work.base);
    const Member& beam = chain_.members[i];
    if (beam.body_at >= 0.0) energy += beam.body.KineticEnergy(work.body_section.CarriedBy(work.base));
  }
  return energy;
}

double EquationsOfMotion::GravityEnergy() const {
  const Vector3d& g = chain_.gravity;
  double energy = 0.0;
  Placement carrier;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Element& element = chain_.elements[i];
    if (element.member >= 0) {
      const MemberWork& work = members_[static_cast<std::size_t>(element.member)];
      const Member& beam = chain_.members[static_cast<std::size_t>(element.member)];
      const Placement base = carrier * element.mount;
      energy -= g.dot(work.inertia.mass() * base.p + base.R * work.inertia.first_moment());
      if (beam.body_at >= 0.0)
        energy -= beam.body.mass * g.dot(base * (work.body_section.pose() * beam.body.com));
    }
    energy -= nodes_[i].body.mass * g.dot(nodes_[i].world * nodes_[i].body.com);
    carrier = nodes_[i].world;
  }
  return energy;
}

double EquationsOfMotion::ElasticEnergy() const {
  double energy = 0.0;
  for (int i = 0; i < n_; ++i)
    energy += chain_.drivetrains[static_cast<std::size_t>(i)].spring.Energy(x_[i] - x_[n_ + i]);
  for (std::size_t i = 0; i < members_.size(); ++i)
    energy += chain_.members[i].elasticity.Energy(members_[i].e);
  return energy;
}

}  // namespace reed::plant
