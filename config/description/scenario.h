// What one run does: plain data in SI units, filled by scenario_file.h from config/scenarios/*.toml.
// Names, units, ranges and defaults of every key: config/README.md. RT: set-up only (it owns heap memory).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "reed/config/description/arm_description.h"

namespace reed {

/// [plant] how the simulated arm is built and integrated.
struct PlantConfig {
  bool flexible_links = true;
  int elements_per_link = 1;  // beam elements per straight member
  double damping_ratio =
      0.005;  // structural damping of every elastic mode, stiffness-proportional at the first mode
  double max_step_s = 0.5e-3;    // largest integration step
  double stiffness_scale = 1.0;  // scales joint and link stiffness alike
  double joint_stiffness_scale = 1.0;
  double friction_scale = 1.0;   // scales viscous and Coulomb friction
  double payload_step_kg = 0.0;  // point mass added at the tool point at payload_step_s
  double payload_step_s = 0.0;
  std::vector<double> p_true;  // true structural parameters; empty: the arm file's
};

/// [drives] from a commanded to an applied torque.
struct DriveConfig {
  int torque_bits = 16;             // resolution over plus/minus the arm's torque limit
  int command_timeout_cycles = 20;  // periods without a valid command before the brakes close
};

/// [sensors] from the truth to a frame.
struct SensorConfig {
  bool wrench = true;                 // a wrist force sensor is fitted
  int encoder_bits = 20;              // per turn
  double velocity_filter_hz = 120.0;  // first-order low pass on the differentiated encoder
  double force_noise_N = 0.05;        // standard deviation per axis
  double force_quantum_N = 0.01;
  double moment_noise_Nm = 0.005;
  double moment_quantum_Nm = 0.001;
  Eigen::Vector3d force_bias_N = Eigen::Vector3d::Zero();
  double force_range_N = 200.0;  // beyond: saturated
  double wrench_lost_from_s =
      -1.0;  // the wrench frames stop in [from, to) of plant time since the drives were enabled; -1: never
  double wrench_lost_to_s = -1.0;
};

/// [wall] the true compliant half-space and where the controller believes it to be.
struct WallConfig {
  bool present = false;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  // on the believed surface, base frame
  Eigen::Vector3d normal{0.0, 0.0, 1.0};              // outward, wall to robot
  double offset_m = 0.0;  // true surface lies at point + offset * normal (negative: lower than believed)
  double stiffness_Npm = 10e3;
  double damping_Nspm = 20.0;
  double friction = 0.1;             // Coulomb coefficient
  double friction_speed_mps = 2e-3;  // speed at which regularised friction reaches its full value
};

/// [disturbance] an external force on the tool point. It acts in front of the wrist sensor, which reads it together
/// with the wall's; no model and no setting of the controller holds it.
struct DisturbanceConfig {
  Eigen::Vector3d bias_N = Eigen::Vector3d::Zero();       // base frame
  Eigen::Vector3d amplitude_N = Eigen::Vector3d::Zero();  // of each of the sinusoids
  std::vector<double> frequencies_hz;  // one sinusoid per entry on every axis, phases from the seed
  Eigen::Vector3d step_N = Eigen::Vector3d::Zero();
  double step_s = -1.0;  // -1: no step
};

/// One leg of the reference, executed in order; the last one holds its end.
struct ReferenceLeg {
  enum class Kind { kHold, kJoint, kCartesian, kSlide, kSine } kind = Kind::kHold;
  double duration_s = 0.0;
  std::vector<double> to_rad;  // kJoint: minimum-jerk to here
  Eigen::Vector3d by_m =
      Eigen::Vector3d::Zero();  // kCartesian: minimum-jerk straight displacement of the tool point
  Eigen::Vector3d amplitude_m =
      Eigen::Vector3d::Zero();        // kSlide: sinusoid about where the leg starts, base frame
  double frequency_hz = 0.0;          // kSlide, kSine
  std::vector<double> amplitude_rad;  // kSine: joint sinusoid about where the leg starts
};

struct ReferenceConfig {
  std::vector<double> start_rad;
  std::vector<ReferenceLeg> legs;
};

/// [force] what the arm shall press with and how it knows.
struct ForceConfig {
  enum class Source { kNone, kKnown, kUnknown, kAuto } source = Source::kNone;
  double desired_N = 0.0;  // F_d after the ramp
  double start_s = 0.0;    // force reference ramps from 0 here (minimum-jerk) ...
  double ramp_s = 0.3;
  double end_s = 1e9;                // ... and back to 0 from here
  double contact_threshold_N = 1.0;  // latches force mode
  double approach_speed_mps = 0.01;  // normal speed while the wall is sought
};

/// [control] the law and its gains. Vectors have one entry per joint, or one entry for all.
struct ControlConfig {
  std::string law = "separated";  // names: config/README.md
  std::vector<double> K_d;        // N·m·s/rad
  std::vector<double> Lambda;     // 1/s
  double Gamma_known = 5.0;       // adaptation gain (34)
  double Gamma_unknown = 0.0;
  double k_p = 4e-3;      // m/(s·N)
  double k_i = 30e-3;     // m/(s²·N)
  double a_force = 60.0;  // 1/s, force filter
  double normal_speed_limit_mps = 0.03;
  bool estimate_wall_stiffness = true;
  double force_bandwidth_radps = 30.0;          // of k_p times the estimated wall stiffness (52)
  double sigma0_gain = 1.0, sigma1_gain = 5.0;  // c_0, c_1
  double sigma0_max = 3.0, sigma1_max = 0.4;
  double phi = 0.03;  // rad/s, boundary layer of sat(s/phi)
  double dead_zone_radps = 0.003;
  double leak_p = 0.05, leak_sigma = 0.2;  // 1/s
  double Gamma_friction = 10.0;            // adaptation gain of Coulomb friction (49), times K_d
  double coulomb_known = 0.0;              // share of the arm's Coulomb friction known at the start
  double friction_speed_radps = 0.01;      // v_s (48)
  double observer_gain = 80.0;             // K_o, 1/s
  bool observer = false;                   // subtract r in free motion
  bool nodal_compensation = true;
  std::vector<double> p_initial;  // empty: the arm file's nominal values
};

/// [limits] the last gate before the bus.
struct LimitConfig {
  double torque_scale = 1.0;         // of the arm's torque limit
  double torque_rate_scale = 500.0;  // 1/s, of each joint's torque limit
  double torque_rate_Nmps = 0.0;     // > 0: the same for every joint instead
  double position_margin_rad = 0.05;
  double speed_scale = 1.0;  // of the arm's speed limit
  double contact_force_N = 60.0;
  int hold_age_cycles = 2;   // measurements up to this age: go on with the last value
  int stop_age_cycles = 10;  // older: ramp the torque down; twice this: fault
};

/// [timing] the loop on the machine.
struct TimingConfig {
  double rate_hz = 1000.0;
  double rx_budget_us = 0.0;       // 0: 40 % of the period, or what the frames take on a wire
  double compute_budget_us = 0.0;  // 0: half of what the others leave
  double tx_budget_us = 0.0;       // 0: half of what the others leave
  enum class Overrun { kKeepGrid, kSkip, kHold, kStop } overrun = Overrun::kKeepGrid;
  int max_missed_in_row = 19;  // more missed cycles in a row: fault
  enum class PhaseAction { kCount, kHold, kDegrade, kFault } phase_action = PhaseAction::kCount;
  int max_broken_in_row = 20;  // phase_action fault: more cycles in a row with a broken budget
  int priority = 80;           // SCHED_FIFO
  int cpu = -1;                // core of the loop, -1: the last one it may use
  int plant_cpu = -1;          // core of the plant, -1: that of the loop
};

/// [[checks]] one line of the verdict.
struct CheckConfig {
  std::string name;  // a figure of the last second or of the run, names: config/README.md
  double limit = 0.0;
};

struct Scenario {
  std::string name;
  std::string description;
  double duration_s = 3.0;  // from the moment the arm is active
  std::int64_t seed = 1;
  bool allow_wire_overload = false;  // run a schedule that a real 1/5 Mbit/s wire could not carry
  ArmDescription arm;
  PlantConfig plant;
  DriveConfig drives;
  SensorConfig sensors;
  WallConfig wall;
  DisturbanceConfig disturbance;
  ReferenceConfig reference;
  ForceConfig force;
  ControlConfig control;
  LimitConfig limits;
  TimingConfig timing;
  std::vector<CheckConfig> checks;
};

}  // namespace reed
