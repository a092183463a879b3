// What drives and sensors say at one instant. Plain data. RT: safe.
#pragma once

#include <array>

#include "reed/bus/codec/messages.h"
#include "reed/plant/sensor/wrench_sensor.h"

namespace reed::plant {

struct Measurement {
  int dof = 0;
  std::array<bus::JointStateMessage, kMaxJoints> joints{};
  WrenchReading wrench;
  bool wrench_lost = false;
};

}  // namespace reed::plant
