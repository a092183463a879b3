#include "reed/plant/dynamics/modes.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reed/plant/dynamics/centre_line.h"
#include "reed/plant/dynamics/equilibrium.h"
#include "reed/plant/dynamics/symmetric_eigen.h"

namespace reed::plant {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<double> BeamModes(double length_m, double EI_Nm2, double rhoA_kgpm, double tip_mass_kg,
                              int elements) {
  if (!(length_m > 0.0) || !(EI_Nm2 > 0.0) || !(rhoA_kgpm > 0.0) || !(tip_mass_kg >= 0.0) || elements < 1)
    throw std::invalid_argument(
        "a beam needs positive length, EI, rhoA and elements, and a tip mass that is not negative");
  // The plant's own elements in a row, without joints. Axial and torsional coordinates take no part in
  // bending.
  ArmChain chain;
  const double length = length_m / elements;
  for (int i = 0; i < elements; ++i) {
    Member member;
    member.length = length;
    member.elasticity = BeamElasticity(length, EI_Nm2, EI_Nm2, EI_Nm2, EI_Nm2);
    member.inertia = BeamInertia(length, rhoA_kgpm, 0.0);
    Element element;
    element.member = i;
    chain.members.push_back(member);
    chain.elements.push_back(element);
  }
  chain.elements.back().body.mass = tip_mass_kg;
  const Wall wall(WallConfig{});
  const EquationsOfMotion equations(chain, wall);

  const int n = kBending * elements;
  const MatrixXd M_all = equations.MassMatrix(), K_all = equations.StiffnessMatrix();
  MatrixXd M(n, n), K(n, n);
  const auto in_plane = [](int i) { return kElastic * (i / kBending) + kA + i % kBending; };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      M(r, c) = M_all(in_plane(r), in_plane(c));
      K(r, c) = K_all(in_plane(r), in_plane(c));
    }
  std::vector<double> frequency_hz;
  for (const double s : GeneralizedEigen(K, M, Wanted::kValues).values)
    frequency_hz.push_back(std::sqrt(s) / (2.0 * std::numbers::pi));
  return frequency_hz;
}

namespace {

/// What bends while the motors are locked: a description may leave out the rotors, which do not move, and
/// either the springs or the members, which are then rigid.
ArmChain LockedChain(TrueArm arm, const PlantModelConfig& config) {
  constexpr double kRigid_Nmprad = 1e9;
  const auto joints = static_cast<std::size_t>(arm.dof());
  if (arm.joint_stiffness_Nmprad.empty() && !arm.bends())
    throw std::invalid_argument("arm " + arm.name +
                                ": nothing bends, it has neither joint_stiffness nor members");
  if (arm.rotor_inertia_kgm2.empty()) arm.rotor_inertia_kgm2.assign(joints, 1.0);
  if (arm.joint_stiffness_Nmprad.empty()) arm.joint_stiffness_Nmprad.assign(joints, kRigid_Nmprad);
  return BuildChain(arm, config);
}

}  // namespace

class ArmModes::Impl {
 public:
  Impl(const TrueArm& arm, const PlantModelConfig& config, const VectorXd& motor_angle_rad)
      : chain_(LockedChain(arm, config)),
        gravity_(chain_.gravity),
        wall_(WallConfig{}),
        equations_(chain_, wall_) {
    const int n = chain_.dof();
    if (motor_angle_rad.size() != n) throw std::invalid_argument("one angle per motor is needed");
    x_ = undeformed_ = VectorXd::Zero(equations_.size());
    undeformed_.head(n) = undeformed_.segment(n, n) = motor_angle_rad;
  }

  Vector3d Load(const Vector3d& tip_force_N, bool gravity) {
    chain_.gravity = gravity ? gravity_ : Vector3d::Zero();
    x_ = undeformed_;
    if (!Settle(equations_, tip_force_N, x_))
      throw std::invalid_argument("the arm finds no equilibrium under this load");
    modes_ = LockedMotorModes(equations_);
    frequency_hz_.assign(modes_.frequency_hz.begin(), modes_.frequency_hz.end());
    return equations_.tool_position();
  }

  std::vector<Vector3d> Points(const VectorXd& x, int samples) const {
    return CentreLine(chain_, samples).At(x);
  }

  std::vector<Vector3d> ModeShape(int index, int samples) {
    if (index < 0 || index >= modes_.frequency_hz.size()) throw std::invalid_argument("no such mode");
    const VectorXd shape = modes_.shape.col(index);
    const double step =
        1e-6 / shape.cwiseAbs().maxCoeff();  // small beside every length, large beside round-off
    std::vector<Vector3d> ahead = Points(x_ + step * shape, samples);
    const std::vector<Vector3d> behind = Points(x_ - step * shape, samples);
    double largest = 0.0;
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      ahead[i] -= behind[i];
      largest = std::max(largest, ahead[i].norm());
    }
    for (Vector3d& point : ahead) point /= largest;
    return ahead;
  }

  const VectorXd& x() const { return x_; }
  const VectorXd& undeformed() const { return undeformed_; }
  const std::vector<double>& frequency_hz() const { return frequency_hz_; }

 private:
  ArmChain chain_;
  Vector3d gravity_;
  Wall wall_;
  EquationsOfMotion equations_;
  VectorXd x_, undeformed_;
  VibrationModes modes_;
  std::vector<double> frequency_hz_;
};

ArmModes::ArmModes(const TrueArm& arm, const PlantModelConfig& config, const VectorXd& motor_angle_rad)
    : impl_(std::make_unique<Impl>(arm, config, motor_angle_rad)) {
  impl_->Load(Vector3d::Zero(), true);
}
ArmModes::~ArmModes() = default;
Vector3d ArmModes::Load(const Vector3d& tip_force_N, bool gravity) {
  return impl_->Load(tip_force_N, gravity);
}
const std::vector<double>& ArmModes::frequency_hz() const { return impl_->frequency_hz(); }
std::vector<Vector3d> ArmModes::Undeformed(int samples) {
  return impl_->Points(impl_->undeformed(), samples);
}
std::vector<Vector3d> ArmModes::Deformed(int samples) { return impl_->Points(impl_->x(), samples); }
std::vector<Vector3d> ArmModes::ModeShape(int index, int samples) { return impl_->ModeShape(index, samples); }

}  // namespace reed::plant
