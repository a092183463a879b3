#include "reed/plant/dynamics/arm_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reed/math/turn.h"
#include "reed/plant/dynamics/mass_split.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kHoldingTorqueOverLimit = 3.0;  // of a brake, over the drive's torque limit
constexpr double kHoldingTorque = 200.0;         // N·m, where the arm file states no torque limit
constexpr double kSameLength = 1e-6;             // m, between a section and its member
constexpr double kSlight = 0.05;                 // of a link's mass: such a rest sits at a member's end
constexpr double kNothing = 1e-14;               // of a mount that is an identity but for round-off
constexpr double kAtEnd = 1e-9;                  // of an element's length: the section at its end

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

void CheckSection(const TrueArm& arm, std::size_t index, double length) {
  const std::string name = "section " + std::to_string(index + 1);
  Require(index < arm.sections.size(), arm,
          name + " is needed for a flexible member of " + std::to_string(length) + " m");
  const BeamSection& s = arm.sections[index];
  Require(
      std::abs(s.length_m - length) <= kSameLength, arm,
      name + " has length " + std::to_string(s.length_m) + " m, its member " + std::to_string(length) + " m");
  Require(s.EA_N > 0.0 && s.EI_Nm2 > 0.0 && s.GJ_Nm2 > 0.0, arm, name + " needs positive EA, EI and GJ");
  Require(s.rhoA_kgpm > 0.0, arm, name + " needs a positive rhoA");
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

/// Base of a member whose x axis points along z (d) or x (a) of the link frame, or against it.
Placement AlongD(double d) {
  const double s = d < 0.0 ? -1.0 : 1.0;
  Matrix3d R;
  R << 0.0, 1.0, 0.0, 0.0, 0.0, s, s, 0.0, 0.0;
  return {R, Vector3d(0.0, 0.0, -d)};
}

Placement AlongA(double a) {
  const double s = a < 0.0 ? -1.0 : 1.0;
  return {Vector3d(s, 1.0, s).asDiagonal().toDenseMatrix(), Vector3d::Zero()};
}

/// Builds the chain link by link; keeps the pose of the last output frame in the frame of the current link.
class Builder {
 public:
  Builder(const TrueArm& arm, const PlantModelConfig& config)
      : arm_(arm),
        config_(config),
        bends_(config.flexible_links && !arm.sections.empty()),
        output_(PlacementOf(arm.base).Inverse()) {
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
    if (!bends_) {
      Attach(chain_.elements.back(), body);
      return;
    }
    std::vector<LinkMember> members = Members(i);
    const RigidBody rest = SplitMass(body, members);

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
    for (std::size_t m = 0; m < members.size(); ++m) AddMember(i, members[m], m == nearest ? at : -1.0, rest);
  }

  ArmChain Finish() {
    Require(!bends_ || section_ == arm_.sections.size(), arm_,
            std::to_string(arm_.sections.size()) + " sections are given, its members are " +
                std::to_string(section_));
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
    const auto add = [&](const Placement& base, double signed_length) {
      if (signed_length == 0.0) return;
      const double length = std::abs(signed_length);
      CheckSection(arm_, section_, length);
      const BeamSection& s = arm_.sections[section_++];
      // A section with one EI for both planes has a polar second moment of area of 2 I: ρ_p = ρA 2I/A.
      members.push_back({base, length, s.rhoA_kgpm, 2.0 * s.rhoA_kgpm * s.EI_Nm2 / s.EA_N, {}});
    };
    sections_of_link_ = section_;
    add(AlongD(arm_.joints[i].d_m), arm_.joints[i].d_m);
    if (i + 1 < arm_.joints.size()) {
      const double along_x = arm_.joints[i + 1].xyz_m.x();
      add(AlongA(along_x), along_x);
    }
    return members;
  }

  /// One member of link i, cut into elements. The rest of the link's mass sits at `at` if that is not
  /// negative.
  void AddMember(std::size_t i, const LinkMember& member, double at, const RigidBody& rest) {
    const BeamSection& s = arm_.sections[sections_of_link_++];
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
      beam.elasticity = BeamElasticity(length, scale * s.EI_Nm2, scale * s.EA_N, scale * s.GJ_Nm2);
      beam.inertia = BeamInertia(length, member.density, member.polar, member.relative);
      beam.link = static_cast<int>(i);
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
  bool bends_;  // rigid where the arm has no sections
  ArmChain chain_;
  Placement output_;                                // last output frame in the current link's frame
  std::size_t section_ = 0, sections_of_link_ = 0;  // next section to read, next one to build
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
