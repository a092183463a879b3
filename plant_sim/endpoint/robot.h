// The arm with its drives and sensors mounted: commands in, measurements out, time passed by the caller.
// Knows neither frames nor clocks. RT: safe after the constructor, except Reset and the first record of an
// event.
#pragma once

#include <cstdint>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/config/plant/plant_config.h"
#include "reed/plant/drive/drive_chain.h"
#include "reed/plant/drive/torque_excitation.h"
#include "reed/plant/dynamics/arm_body.h"
#include "reed/plant/endpoint/journal.h"
#include "reed/plant/sensor/encoder.h"
#include "reed/plant/sensor/measurement.h"
#include "reed/plant/sensor/velocity_filter.h"
#include "reed/plant/sensor/wrench_sensor.h"

namespace reed::plant {

class Robot {
 public:
  /// `body` and `journal` outlive the robot.
  Robot(const PlantConfig& config, ArmBody& body, Journal& journal);

  /// t = 0: at rest in reference.start_rad, drives off, brakes closed, sensors as after power-up.
  void Reset();

  /// Reads every sensor once. Successive calls are the sampling instants of the speed filter and the noise.
  Measurement Measure();

  /// A command whose frame was accepted; false when it was refused for a torque that is not finite.
  bool Command(const bus::CommandMessage& command);

  /// Time without a command, in controller periods: the drives brake after a while.
  void Silence(double periods);

  /// Physics for dt_s with the torques that the drives apply now. A body that diverges faults the drives.
  void Advance(double dt_s);

  /// Truth of this instant for telemetry.
  PlantRecord Snapshot(const HostPauses& host) const;

  /// The arm's shape of this instant for telemetry, thinned out to what a record holds.
  ShapeRecord ShapeSnapshot();

  double time_s() const noexcept { return time_s_; }
  /// Since the drives were enabled; negative before.
  double enabled_for_s() const noexcept { return enabled_s_ >= 0.0 ? time_s_ - enabled_s_ : -1.0; }
  bool healthy() const { return body_.healthy(); }
  const DriveChain& drives() const noexcept { return drives_; }

 private:
  /// Notes what a command, a silence or the physics changed.
  void NoteDriveChange(bus::DriveState before);
  void NoteContactChange();

  ArmBody& body_;
  Journal& journal_;
  Eigen::VectorXd start_rad_;
  DriveChain drives_;
  TorqueExcitation excitation_;
  Eigen::VectorXd excited_Nm_;  // what the arm gets while there is an excitation
  std::vector<JointEncoder> encoders_;
  std::vector<VelocityFilter> speeds_;
  WrenchSensor wrench_;
  double time_s_ = 0.0;
  double sampled_s_ = 0.0;
  double enabled_s_ = -1.0;  // when the drives were enabled last, -1: never in this run
  bus::DriveRequest request_ = bus::DriveRequest::kOff;
  bool in_contact_ = false;
};

}  // namespace reed::plant
