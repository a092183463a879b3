// ArmPlant as the body under drives and sensors.
#pragma once

#include <string>

#include "reed/plant/dynamics/arm_body.h"

namespace reed::plant {

class FlexibleArmBody final : public ArmBody {
 public:
  explicit FlexibleArmBody(const PlantConfig& config) : plant_(config) {}
  void Reset(const Eigen::VectorXd& motor_angle_rad) override { plant_.Reset(motor_angle_rad); }
  void Advance(const Eigen::VectorXd& motor_torque_Nm, bool braked, double dt_s) override {
    plant_.Advance(motor_torque_Nm, braked, dt_s);
  }
  void StartSchedule() override { plant_.StartSchedule(); }
  void ForceBrakes(std::uint32_t closed, std::uint32_t open) override { plant_.ForceBrakes(closed, open); }
  const Truth& truth() const override { return plant_.truth(); }
  const ArmShape& Shape() override { return plant_.Shape(); }
  bool healthy() const override { return plant_.healthy(); }
  std::string fault_description() const override { return plant_.fault_description(); }

 private:
  ArmPlant plant_;
};

}  // namespace reed::plant
