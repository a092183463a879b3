// A multisine on one joint's torque, between the drive and the arm: what tools/reed bode measures the loop with. The controller does
// not know it, and it is in no frame. RT: safe after the constructor.
#pragma once

#include <cstddef>
#include <vector>

#include "reed/config/plant/plant_config.h"

namespace reed::plant {

class TorqueExcitation {
 public:
  explicit TorqueExcitation(const DriveConfig& config);

  bool active() const noexcept { return joint_ >= 0; }
  int joint() const noexcept { return joint_; }  // from 0

  /// N·m at the plant's time: sum of A cos(2π f_k t - π k (k - 1) / K) (Schroeder: a low peak for its rms). tools/reed_tools/bode has
  /// the same sum.
  double At(double time_s) const noexcept;

 private:
  struct Line {
    double omega_radps, phase_rad;
  };
  int joint_;
  double amplitude_Nm_;
  std::vector<Line> lines_;
};

}  // namespace reed::plant
