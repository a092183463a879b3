// What drives and sensors are mounted on. The program mounts them on ArmPlant; tests on bodies with closed
// forms.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "reed/plant/dynamics/arm_plant.h"

namespace reed::plant {

/// The members and their promises are ArmPlant's.
class ArmBody {
 public:
  virtual ~ArmBody() = default;
  virtual void Reset(const Eigen::VectorXd& motor_angle_rad) = 0;
  virtual void Advance(const Eigen::VectorXd& motor_torque_Nm, bool braked, double dt_s) = 0;
  virtual void StartSchedule() = 0;
  virtual void ForceBrakes(std::uint32_t /*closed*/, std::uint32_t /*open*/) {}
  virtual const Truth& truth() const = 0;
  virtual const ArmShape& Shape() = 0;
  virtual bool healthy() const = 0;
  virtual std::string fault_description() const = 0;
};

}  // namespace reed::plant
