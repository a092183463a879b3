// A brake that no longer follows its drive. An announced one is a fault of that drive. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class StuckBrake : public Fault {
 public:
  using Stuck = std::uint32_t Actuation::*;
  StuckBrake(const Making& making, Stuck stuck) noexcept : Fault(making), stuck_(stuck) {}

  void OnActuation(Actuation& act, const Moment&) noexcept override {
    target().ForEachJoint(act.dof(), [&](int joint) { act.*stuck_ |= 1U << static_cast<unsigned>(joint); });
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    if (!announced()) return;
    target().ForEachJoint(
        m.dof, [&](int joint) { m.joints[static_cast<std::size_t>(joint)].state = bus::DriveState::kFault; });
  }

 private:
  Stuck stuck_;
};

}  // namespace reed::plant
