// The plant's half of a scenario: the truth of the simulated arm, its drives, sensors and surroundings.
// Names, units, ranges and defaults of every key: config/README.md. RT: set-up only (it owns heap memory).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "reed/config/description/sensor_data.h"
#include "reed/config/description/timing_config.h"
#include "reed/config/plant/fault_config.h"
#include "reed/config/plant/true_arm.h"

namespace reed {

/// [plant] how the simulated arm is built and integrated.
struct PlantModelConfig {
  bool flexible_links = true;
  int elements_per_link = 1;  // beam elements per straight member
  double damping_ratio =
      0.005;  // structural damping of every elastic mode, stiffness-proportional at the first mode
  double max_step_s = 1e-3;      // largest integration step
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
  int excitation_joint = 0;         // from 1; 0: no excitation
  double excitation_Nm = 0.0;       // of each sinusoid that is added to this joint's torque
  std::vector<double> excitation_hz;
};

/// [sensors] from the truth to a frame.
struct SensorConfig : SensorData {
  double encoder_noise_rad = 0.0;  // standard deviation of an angle, before it becomes a mark
  double moment_noise_Nm = 0.005;
  double moment_quantum_Nm = 0.001;
  Eigen::Vector3d force_bias_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_bias_Nm = Eigen::Vector3d::Zero();
  double wrench_lost_from_s =
      -1.0;  // the wrench frames stop in [from, to) of plant time since the drives were enabled; -1: never
  double wrench_lost_to_s = -1.0;
};

/// [wall] the true compliant half-space and where the controller believes it to be.
struct WallConfig {
  bool present = false;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  // on the believed surface, world frame
  Eigen::Vector3d normal{0.0, 0.0, 1.0};              // outward, wall to robot
  double offset_m = 0.0;  // true surface lies at point + offset * normal (negative: lower than believed)
  double stiffness_Npm = 10e3;
  double damping_Nspm = 20.0;
  double friction = 0.1;             // Coulomb coefficient
  double friction_speed_mps = 2e-3;  // speed at which regularised friction reaches its full value
};

/// [disturbance] an external force on the tool point; no model and no setting of the controller holds it.
struct DisturbanceConfig {
  /// kTool: in front of the wrist sensor, which reads it together with the wall's. kArm: behind it, where the arm is
  /// pushed by the same force and the sensor reads nothing.
  enum class Where { kTool, kArm } where = Where::kTool;
  Eigen::Vector3d bias_N = Eigen::Vector3d::Zero();       // world frame
  Eigen::Vector3d amplitude_N = Eigen::Vector3d::Zero();  // of each of the sinusoids
  std::vector<double> frequencies_hz;  // one sinusoid per entry on every axis, phases from the seed
  Eigen::Vector3d step_N = Eigen::Vector3d::Zero();
  double step_s = -1.0;  // -1: no step
};

/// One direction of [link].
struct PathConfig {
  double delay_s = 0.0;
  double jitter_s = 0.0;  // between 0 and this more, alike
  double loss = 0.0;      // share of the frames

  bool active() const { return delay_s > 0.0 || jitter_s > 0.0 || loss > 0.0; }
};

/// [link] what lies between controller and arm, in virtual time.
struct LinkConfig {
  bool wire_time = false;        // a frame arrives when a 1/5 Mbit/s CAN FD wire would have it
  double foreign_load = 0.0;     // share of that wire that others take
  int foreign_id = -1;           // their identifier; -1: any
  double controller_s = 100e-6;  // from the last answer's arrival to the command's sending
  PathConfig command, measurement;

  bool active() const { return wire_time || command.active() || measurement.active(); }
};

struct PlantConfig {
  std::int64_t seed = 1;
  TrueArm arm;
  PlantModelConfig plant;
  DriveConfig drives;
  SensorConfig sensors;
  WallConfig wall;
  DisturbanceConfig disturbance;
  std::vector<double> start_rad;  // motor-side joint angles at t = 0
  TimingConfig timing;
  std::vector<FaultConfig> faults;
  LinkConfig link;
};

}  // namespace reed
