// A scenario file as it stands, with its arm: both halves. Only the reader of files and the tools that show
// everything hold it; the programs take their half (halves.h). RT: set-up only (it owns heap memory).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reed/config/controller/controller_config.h"
#include "reed/config/plant/plant_config.h"
#include "reed/config/schema/arm_description.h"

namespace reed {

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
  PlantModelConfig plant;
  DriveConfig drives;
  SensorConfig sensors;
  WallConfig wall;
  DisturbanceConfig disturbance;
  LinkConfig link;
  ReferenceConfig reference;
  ForceConfig force;
  ControlConfig control;
  LimitConfig limits;
  TimingConfig timing;
  std::vector<FaultConfig> faults;
  std::vector<CheckConfig> checks;
};

}  // namespace reed
