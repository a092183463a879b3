// The controller's half of a scenario: what it may know and what it shall do. Nothing here is a true value of
// the simulated arm, wall or sensors. Names, units, ranges and defaults of every key: config/README.md.
// RT: set-up only (it owns heap memory).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "reed/config/controller/nominal_arm.h"
#include "reed/config/description/sensor_data.h"
#include "reed/config/description/timing_config.h"

namespace reed {

/// [wall] where the controller believes the surface to be.
struct BelievedWall {
  bool present = false;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  // on the believed surface, world frame
  Eigen::Vector3d normal{0.0, 0.0, 1.0};              // outward, wall to robot
};

/// One leg of the reference, executed in order; the last one holds its end.
struct ReferenceLeg {
  enum class Kind { kHold, kJoint, kCartesian, kSlide, kSine, kFourier } kind = Kind::kHold;
  double duration_s = 0.0;
  std::vector<double> to_rad;  // kJoint: minimum-jerk to here
  Eigen::Vector3d by_m =
      Eigen::Vector3d::Zero();  // kCartesian: minimum-jerk straight displacement of the tool point
  Eigen::Vector3d amplitude_m =
      Eigen::Vector3d::Zero();        // kSlide: sinusoid about where the leg starts, world frame
  double frequency_hz = 0.0;          // kSlide, kSine; kFourier: of the first harmonic
  std::vector<double> amplitude_rad;  // kSine: joint sinusoid about where the leg starts
  std::vector<std::vector<double>> sine_rad, cosine_rad;  // kFourier: per harmonic and joint (fourier_leg.h)
};

struct ReferenceConfig {
  std::vector<double> start_rad;
  std::vector<double> start_tip_m;  // empty once start_rad, the angles for it, were found
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
  double coulomb_known =
      0.0;  // share of the true Coulomb friction known at the start; the loaders apply it to NominalArm
  double friction_speed_radps = 0.01;  // v_s (48)
  double observer_gain = 80.0;         // K_o, 1/s
  bool observer = false;               // subtract r in free motion
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
  // Of the monitors of the devices (core/safety/monitors.h); shares of the arm's torque and speed limits.
  double torque_error_share = 0.1;
  double speed_error_share = 0.05;
  double unexplained_torque_share = 0.1;
  double following_error_share = 0.1;
  double stuck_rad = 0.012;
  double standstill_rad = 0.01;
  double tip_speed_mps = 0.0;  // 0: none
  double power_W = 0.0;        // 0: none
  double energy_J = 0.0;       // 0: none
  bool monitors = true;        // false: nothing trips
};

struct ControllerConfig {
  std::string name;                  // of the scenario
  double duration_s = 3.0;           // from the moment the arm is active
  std::int64_t seed = 1;             // of the run, for its record
  bool allow_wire_overload = false;  // run a schedule that a real 1/5 Mbit/s wire could not carry
  NominalArm arm;
  SensorData sensors;
  BelievedWall wall;
  ReferenceConfig reference;
  ForceConfig force;
  ControlConfig control;
  LimitConfig limits;
  TimingConfig timing;
};

}  // namespace reed
