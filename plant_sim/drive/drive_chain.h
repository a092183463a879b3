// The drives of all joints as one safety chain: they change state together, brakes open and close together.
// RT: safe after the constructor.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/config/plant/plant_config.h"
#include "reed/plant/drive/torque_output.h"

namespace reed::plant {

class DriveChain {
 public:
  DriveChain(const TrueArm& arm, const DriveConfig& config);

  /// Power-up: off, brakes closed, nothing remembered of any controller.
  void Reset() noexcept;

  /// A command that passed the frame protection. `fastest_radps`: largest motor speed, positive.
  /// False, and nothing changes, when a torque is not finite: such a command counts as none.
  bool Command(bus::DriveRequest request, std::span<const double> torque_Nm, double fastest_radps) noexcept;

  /// Time without a valid command, in controller periods. Brakes at DriveConfig::command_timeout_cycles.
  void Silence(double periods) noexcept;

  /// Something is wrong with the arm itself: brakes close until Reset.
  void Fault() noexcept;

  bus::DriveState state() const noexcept { return state_; }
  bool braked() const noexcept;

  /// Applied torques, N·m; zero while the brakes are closed.
  const Eigen::VectorXd& torque_Nm() const noexcept { return torque_Nm_; }

 private:
  void Enter(bus::DriveState state) noexcept;

  std::vector<TorqueOutput> outputs_;
  double timeout_periods_;
  bus::DriveState state_ = bus::DriveState::kOff;
  bus::DriveRequest request_ = bus::DriveRequest::kOff;
  double silent_periods_ = 0.0;
  Eigen::VectorXd torque_Nm_;
};

}  // namespace reed::plant
