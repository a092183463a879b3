#include "reed/plant/dynamics/arm_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reed/config/description/members.h"
#include "reed/math/turn.h"
#include "reed/plant/dynamics/mass_split.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kHoldingTorqueOverLimit = 3.0;  // of a brake, over the drive's torque limit
constexpr double kHoldingTorque = 200.0;         // N·m, where the arm file states no torque limit
constexpr double kSlight = 0.05;                 // of a link's mass: such a rest sits at a member's end
constexpr double kNothing = 1e-14;               // of a mount that is an identity but for round-off
constexpr double kAtEnd = 1e-9;                  // of an element's length: the section at its end
constexpr double kMassless = 1e-6;               // of the arm's mass, along a member that has none

void Require(bool condition, const TrueArm& arm, const std::string& what) {
  if (!condition) throw std::invalid_argument("arm " + arm.name + " cannot be simulated: " + what);
}

void CheckDrives(const TrueArm& arm) {
  const auto n = static_cast<std::size_t>(arm.dof());
  Require(n > 0 && n <= static_cast<std::size_t>(kMaxJoints), arm,
          "it needs 1 to " + std::to_string(kMaxJoints) + " joints");
  Require(arm.bodies.size() == n, arm, "one body per link is needed");
  Require(arm.rotor_inertia_kgm2.size() == n, arm, "rotor inertia of every joint is needed");
  Require(arm.joint_stiffness_Nmprad.size() == n, arm, "stiffness of every joint is needed");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string joint = " of joint " + std::to_string(i + 1) + " must be positive";
    Require(arm.rotor_inertia_kgm2[i] > 0.0, arm, "rotor inertia" + joint);
    Require(arm.joint_stiffness_Nmprad[i] > 0.0, arm, "stiffness" + joint);
  }
}

void CheckMembers(const TrueArm& arm, const std::vector<FlexibleMember>& members) {
  for (std::size_t j = 0; j < members.size(); ++j) {
    const FlexibleMember& m = members[j];
    const std::string name = "member " + std::to_string(j + 1);
    Require(m.link >= 0 && m.link < arm.dof() && (j == 0 || members[j - 1].link <= m.link), arm,
            name + " needs a link of the arm, base to tip");
    Require(m.length_m() > 0.0, arm, name + " needs two ends that are apart");
    Require(m.EA_N > 0.0 && m.EI_y_Nm2 > 0.0 && m.EI_z_Nm2 > 0.0 && m.GJ_Nm2 > 0.0, arm,
            name + " needs positive EA, EI and GJ");
    Require(m.rhoA_kgpm >= 0.0, arm, name + " needs a rhoA that is not negative");
  }
}

double At(const std::vector<double>& values, std::size_t i, double otherwise) {
  return i < values.size() ? values[i] : otherwise;
}

Drivetrain BuildDrivetrain(const TrueArm& arm, const PlantModelConfig& config, std::size_t i) {
  const double scale = config.stiffness_scale * config.joint_stiffness_scale;
  Drivetrain drive;
  drive.rotor_inertia = arm.rotor_inertia_kgm2[i];
  drive.spring.k_q = scale * arm.joint_stiffness_Nmprad[i];
  drive.spring.k_3 = scale * At(arm.joint_hardening_Nmprad3, i, 0.0);
  drive.friction.viscous = config.friction_scale * At(arm.viscous_Nmsprad, i, 0.0);
  drive.friction.coulomb = config.friction_scale * At(arm.coulomb_Nm, i, 0.0);
  const double limit = At(arm.torque_limit_Nm, i, 0.0);
  drive.holding_torque = limit > 0.0 ? kHoldingTorqueOverLimit * limit : kHoldingTorque;
  return drive;
}

Placement Shift(const Vector3d& p) { return {Matrix3d::Identity(), p}; }

/// Turned about its own axes in turn: z, then y, then x. The same frame as about the fixed x, y, z.
Placement PlacementOf(const FixedFrame& frame) {
  const Vector3d& rpy = frame.rpy_rad;
  return {math::TurnZ(rpy.z()) * math::TurnY(rpy.y()) * math::TurnX(rpy.x()), frame.xyz_m};
}

/// Builds the chain link by link; keeps the pose of the last output frame in the frame of the current link.
class Builder {
 public:
  Builder(const TrueArm& arm, const PlantModelConfig& config)
      : arm_(arm), config_(config), output_(PlacementOf(arm.base).Inverse()) {
    if (config.flexible_links) flexible_ = FlexibleMembers(arm);
    CheckMembers(arm, flexible_);
    for (const InertialBody& body : arm.bodies) mass_kg_ += body.mass_kg;
    chain_.base = arm.base.xyz_m;
    chain_.gravity = arm.gravity_mps2;
  }

  void AddJoint(std::size_t i) {
    const Joint& joint = arm_.joints[i];
    Element turn;
    turn.mount = output_.Inverse() * PlacementOf(joint);
    turn.mount.R = (turn.mount.R * math::TurnZ(joint.offset_rad)).eval();
    turn.joint = static_cast<int>(i);
    chain_.elements.push_back(turn);
    chain_.drivetrains.push_back(BuildDrivetrain(arm_, config_, i));
    output_ = Shift({0.0, 0.0, -joint.d_m});
  }

  void AddLink(std::size_t i) {
    const InertialBody& b = arm_.bodies[i];
    const RigidBody body{b.mass_kg, b.com_m, b.inertia_com_kgm2};
    const std::size_t first = next_;
    std::vector<LinkMember> members = Members(i);
    const RigidBody rest = SplitMass(body, members);
    for (LinkMember& member : members) GiveMass(member);

    std::size_t nearest = members.size();
    double at = 0.0, distance = 0.0;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Vector3d from_base = members[m].base.Inverse() * rest.com;
      double l = std::clamp(from_base.x(), 0.0, members[m].length);
      if (rest.mass < kSlight * body.mass) l = 2.0 * l < members[m].length ? 0.0 : members[m].length;
      const double d = (from_base - Vector3d(l, 0.0, 0.0)).norm();
      if (nearest < members.size() && d >= distance) continue;
      nearest = m;
      at = l;
      distance = d;
    }
    if (members.empty()) Attach(chain_.elements.back(), rest);
    for (std::size_t m = 0; m < members.size(); ++m)
      AddMember(flexible_[first + m], members[m], m == nearest ? at : -1.0, rest);
  }

  ArmChain Finish() {
    chain_.tool = output_.Inverse() * Shift(arm_.tool.xyz_m);
    chain_.force_sensor = output_.Inverse() * PlacementOf(arm_.force_sensor);
    chain_.sensed_mass = arm_.force_sensor.tool_mass_kg;
    chain_.sensed_com = arm_.force_sensor.tool_com_m;
    for (Element& element : chain_.elements) {
      element.mount_turns = !element.mount.R.isIdentity(kNothing);
      element.mount_shifts = !element.mount.p.isZero(kNothing);
    }
    return std::move(chain_);
  }

 private:
  void Attach(Element& element, const RigidBody& body) {
    element.body = Join(element.body, InParent(output_.Inverse(), body));
  }

  std::vector<LinkMember> Members(std::size_t i) {
    std::vector<LinkMember> members;
    for (; next_ < flexible_.size() && flexible_[next_].link == static_cast<int>(i); ++next_) {
      const FlexibleMember& m = flexible_[next_];
      // The polar second moment of area is the sum of both others: ρ_p = ρA (I_y + I_z)/A.
      const double polar = m.rhoA_kgpm * (m.EI_y_Nm2 + m.EI_z_Nm2) / m.EA_N;
      members.push_back({{m.axes(), m.from_m}, m.length_m(), m.rhoA_kgpm, polar, {}});
    }
    return members;
  }

  /// Every elastic coordinate has an acceleration: a member without mass gets one that no figure shows, for its own
  /// bending and twisting alone.
  void GiveMass(LinkMember& member) const {
    if (member.density + member.relative.density > 0.0) return;
    member.relative.density = kMassless * (mass_kg_ > 0.0 ? mass_kg_ : 1.0) / member.length;
    member.relative.polar = member.relative.density * kMassless * member.length * member.length;
  }

  /// One member, cut into elements. The rest of the link's mass sits at `at` if that is not negative.
  void AddMember(const FlexibleMember& s, const LinkMember& member, double at, const RigidBody& rest) {
    const double scale = config_.stiffness_scale;
    const int count = config_.elements_per_link;
    const double length = member.length / count;
    for (int k = 0; k < count; ++k) {
      const double from = k * length, local = at - from;
      const bool here =
          at >= 0.0 && (local <= length * (1.0 + kAtEnd)) && (k == 0 || local > length * kAtEnd);
      const Placement base = member.base * Shift({from, 0.0, 0.0});
      if (here && local <= length * kAtEnd) Attach(chain_.elements.back(), rest);

      Member beam;
      beam.length = length;
      beam.elasticity =
          BeamElasticity(length, scale * s.EI_y_Nm2, scale * s.EI_z_Nm2, scale * s.EA_N, scale * s.GJ_Nm2);
      beam.inertia = BeamInertia(length, member.density, member.polar, member.relative);
      beam.link = s.link;
      if (here && local > length * kAtEnd && local < length * (1.0 - kAtEnd)) {
        beam.body_at = local;
        beam.body = InParent((base * Shift({local, 0.0, 0.0})).Inverse(), rest);
      }
      Element element;
      element.mount = output_.Inverse() * base;
      element.member = static_cast<int>(chain_.members.size());
      chain_.members.push_back(beam);
      chain_.elements.push_back(element);
      output_ = base * Shift({length, 0.0, 0.0});
      if (here && local >= length * (1.0 - kAtEnd)) Attach(chain_.elements.back(), rest);
    }
  }

  const TrueArm& arm_;
  const PlantModelConfig& config_;
  std::vector<FlexibleMember> flexible_;  // base to tip; what is not among them is rigid
  double mass_kg_ = 0.0;                  // of the whole arm
  ArmChain chain_;
  Placement output_;      // last output frame in the current link's frame
  std::size_t next_ = 0;  // of flexible_
};

}  // namespace

ArmChain BuildChain(const TrueArm& arm, const PlantModelConfig& config) {
  CheckDrives(arm);
  Require(config.elements_per_link >= 1, arm, "elements_per_link must be at least 1");
  Require(config.stiffness_scale > 0.0 && config.joint_stiffness_scale > 0.0, arm,
          "stiffness scales must be positive");
  Builder builder(arm, config);
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    builder.AddJoint(i);
    builder.AddLink(i);
  }
  return builder.Finish();
}

void SetStructuralDamping(ArmChain& chain, double beta_s) {
  for (Drivetrain& drive : chain.drivetrains) drive.spring.d = beta_s * drive.spring.k_q;
  for (Member& member : chain.members) member.elasticity.beta = beta_s;
}

}  // namespace reed::plant
