#include "reed/plant/dynamics/arm_plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "reed/plant/dynamics/centre_line.h"
#include "reed/plant/dynamics/disturbance.h"
#include "reed/plant/dynamics/equilibrium.h"
#include "reed/plant/dynamics/mounted_force_sensor.h"
#include "reed/plant/dynamics/rosenbrock.h"

namespace reed::plant {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kShapeSamples =
    2;  // inside each element: its bending is a polynomial of degree 3 and small bubbles
constexpr double kAbsurdSpeed = 1e3;  // rad/s of a joint or motor; arms of this class stay below 20

std::vector<Brake> BuildBrakes(const ArmChain& chain) {
  std::vector<Brake> brakes;
  for (const Drivetrain& drive : chain.drivetrains) {
    const double stiffness = 10.0 * drive.spring.k_q;  // a closed brake is stiff beside the gearbox it holds
    brakes.emplace_back(stiffness, 2.0 * std::sqrt(stiffness * drive.rotor_inertia), drive.holding_torque);
  }
  return brakes;
}

}  // namespace

class ArmPlant::Impl {
 public:
  explicit Impl(const PlantConfig& config)
      : config_(config.plant),
        chain_(BuildChain(config.arm, config.plant)),
        wall_(config.wall),
        disturbance_(config.disturbance, config.seed),
        equations_(chain_, wall_),
        integrator_(equations_.size()),
        brakes_(BuildBrakes(chain_)),
        acting_(brakes_.size()),
        sensor_(chain_),
        centre_line_(chain_, kShapeSamples) {
    if (!(config_.max_step_s > 0.0)) throw std::invalid_argument("plant.max_step_s must be positive");
    const int n = chain_.dof();
    x_ = x_dot_ = undeformed_ = VectorXd::Zero(equations_.size());
    begin_.motor_torque = end_.motor_torque = VectorXd::Zero(n);
    truth_.motor_angle_rad = truth_.motor_speed_radps = truth_.joint_angle_rad = VectorXd::Zero(n);
    const bool starts =
        config.start_rad.size() == static_cast<std::size_t>(n);  // another pose may have no equilibrium
    Reset(starts ? VectorXd(Eigen::Map<const VectorXd>(config.start_rad.data(), n))
                 : VectorXd(VectorXd::Zero(n)));
    Shape();
  }

  void Reset(const VectorXd& motor_angle_rad) {
    const int n = chain_.dof();
    if (motor_angle_rad.size() != n)
      throw std::invalid_argument("ArmPlant::Reset: one angle per motor is needed");
    if (untouched_ && motor_angle_rad == rest_rad_) return;
    untouched_ = false;
    t_ = 0.0;
    schedule_from_ = kNever;
    closed_ = 0;
    sick_coordinate_ = -1;
    SetPayload(0.0);
    loaded_ = false;
    x_.setZero();
    x_.head(n) = x_.segment(n, n) = motor_angle_rad;
    x_dot_.setZero();
    if (!Settle(equations_, Vector3d::Zero(), x_)) throw NoEquilibrium();
    // Structural damping: the given ratio at the lowest frequency, proportional to stiffness beyond it.
    const double lowest_hz = LockedMotorModes(equations_).frequency_hz[0];
    SetStructuralDamping(chain_, 2.0 * config_.damping_ratio / (2.0 * std::numbers::pi * lowest_hz));
    sensor_.Rest();
    UpdateTruth();
    rest_rad_ = motor_angle_rad;
    untouched_ = true;
  }

  void Advance(const VectorXd& motor_torque_Nm, bool braked, double dt_s) {
    const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / config_.max_step_s - 1e-9)));
    const double h = dt_s / steps;
    untouched_ = false;
    begin_.motor_torque = end_.motor_torque = motor_torque_Nm;
    OperateBrakes(braked);
    for (int i = 0; i < steps && sick_coordinate_ < 0; ++i) {
      TakePayload();
      begin_.disturbance = disturbance_.Force(t_, t_ - schedule_from_);
      end_.disturbance = disturbance_.Force(t_ + h, t_ + h - schedule_from_);
      sensor_.Begin(equations_);
      integrator_.Step(equations_, begin_, end_, h, x_, x_dot_);
      sensor_.End(equations_, h);
      t_ += h;
      if (closed_ != 0)
        for (std::size_t j = 0; j < acting_.size(); ++j) acting_[j].Follow(x_[static_cast<Eigen::Index>(j)]);
      Diagnose();
    }
    UpdateTruth();
  }

  void ForceBrakes(std::uint32_t closed, std::uint32_t open) {
    forced_closed_ = closed;
    forced_open_ = open;
  }

  void StartSchedule() {
    untouched_ = false;
    schedule_from_ = t_;
  }

  const Truth& truth() const { return truth_; }

  const ArmShape& Shape() {
    const int n = chain_.dof();
    undeformed_.head(n) = undeformed_.segment(n, n) = x_.head(n);
    shape_.bent = centre_line_.At(x_);
    shape_.rigid = centre_line_.At(undeformed_);
    return shape_;
  }

  bool healthy() const { return sick_coordinate_ < 0; }
  int num_coordinates() const { return equations_.size(); }

  std::string fault_description() const {
    if (healthy()) return "";
    const int n = chain_.dof(), elastic = sick_coordinate_ - 2 * n;
    std::ostringstream text;
    if (elastic < 0) {
      text << (sick_coordinate_ < n ? "motor " : "joint ") << sick_coordinate_ % n + 1 << " at angle "
           << x_[sick_coordinate_] << " rad, speed " << x_dot_[sick_coordinate_] << " rad/s";
    } else {
      text << "elastic coordinate " << elastic % kElastic + 1 << " of element " << elastic / kElastic + 1
           << " at " << x_[sick_coordinate_] << ", rate " << x_dot_[sick_coordinate_] << " 1/s";
    }
    text << ", t = " << t_ << " s";
    return text.str();
  }

 private:
  void OperateBrakes(bool braked) {
    const std::uint32_t commanded = braked ? ~0U : 0U;
    const std::uint32_t closed =
        ((commanded | forced_closed_) & ~forced_open_) & ((1U << brakes_.size()) - 1U);
    for (std::size_t j = 0; j < brakes_.size(); ++j) {
      const bool now = (closed >> j & 1U) != 0, before = (closed_ >> j & 1U) != 0;
      if (now && !before) {
        acting_[j] = brakes_[j];
        acting_[j].Close(x_[static_cast<Eigen::Index>(j)]);
      }
      if (!now) acting_[j] = Brake();
    }
    closed_ = closed;
    begin_.brakes = end_.brakes = closed_ != 0 ? &acting_ : nullptr;
    if (braked) begin_.motor_torque.setZero(), end_.motor_torque.setZero();
  }

  void TakePayload() {
    if (loaded_ || config_.payload_step_kg == 0.0 || t_ - schedule_from_ < config_.payload_step_s) return;
    SetPayload(config_.payload_step_kg);
    loaded_ = true;
  }

  void SetPayload(double mass_kg) {
    equations_.SetPayload(mass_kg);
    sensor_.SetPayload(mass_kg);
  }

  void Diagnose() {
    for (Eigen::Index i = 0; i < x_.size() && sick_coordinate_ < 0; ++i)
      if (!std::isfinite(x_[i]) || !(std::abs(x_dot_[i]) < kAbsurdSpeed))
        sick_coordinate_ = static_cast<int>(i);
  }

  void UpdateTruth() {
    const int n = chain_.dof();
    truth_.t_s = t_;
    truth_.motor_angle_rad = x_.head(n);
    truth_.motor_speed_radps = x_dot_.head(n);
    truth_.joint_angle_rad = x_.segment(n, n);
    truth_.tip_m = equations_.tool_position();
    truth_.tip_velocity_mps = equations_.tool_velocity();
    truth_.contact_force_N = equations_.contact().force + disturbance_.Force(t_, t_ - schedule_from_);
    const Wrench sensed =
        sensor_.Feel(equations_, disturbance_.sensed() ? truth_.contact_force_N : equations_.contact().force);
    truth_.sensed_force_N = sensed.force;
    truth_.sensed_moment_Nm = sensed.moment;
    truth_.normal_force_N = equations_.contact().normal_force;
    truth_.gap_m = equations_.contact().gap;
    truth_.kinetic_J = equations_.KineticEnergy();
    truth_.elastic_J = equations_.ElasticEnergy();
    truth_.potential_J = equations_.GravityEnergy();
  }

  PlantModelConfig config_;
  ArmChain chain_;
  Wall wall_;
  Disturbance disturbance_;
  EquationsOfMotion equations_;
  Rosenbrock integrator_;
  std::vector<Brake> brakes_, acting_;  // as built; as they are now, an open one does nothing
  MountedForceSensor sensor_;
  CentreLine centre_line_;
  VectorXd x_, x_dot_, undeformed_;
  Load begin_, end_;
  Truth truth_;
  ArmShape shape_;
  double t_ = 0.0;
  double schedule_from_ = kNever;                                   // in t_
  std::uint32_t closed_ = 0, forced_closed_ = 0, forced_open_ = 0;  // brakes, a bit per motor
  bool loaded_ = false;
  VectorXd rest_rad_;       // of the last Reset
  bool untouched_ = false;  // since then: the same again changes nothing, and takes as long as 50 cycles
  int sick_coordinate_ = -1;
};

ArmPlant::ArmPlant(const PlantConfig& config) : impl_(std::make_unique<Impl>(config)) {}
ArmPlant::~ArmPlant() = default;
void ArmPlant::Reset(const VectorXd& motor_angle_rad) { impl_->Reset(motor_angle_rad); }
void ArmPlant::Advance(const VectorXd& motor_torque_Nm, bool braked, double dt_s) {
  impl_->Advance(motor_torque_Nm, braked, dt_s);
}
void ArmPlant::ForceBrakes(std::uint32_t closed, std::uint32_t open) { impl_->ForceBrakes(closed, open); }
void ArmPlant::StartSchedule() { impl_->StartSchedule(); }
const Truth& ArmPlant::truth() const { return impl_->truth(); }
const ArmShape& ArmPlant::Shape() { return impl_->Shape(); }
bool ArmPlant::healthy() const { return impl_->healthy(); }
std::string ArmPlant::fault_description() const { return impl_->fault_description(); }
int ArmPlant::num_coordinates() const { return impl_->num_coordinates(); }

}  // namespace reed::plant
