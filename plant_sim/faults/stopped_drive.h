// A drive that is out of service: no torque, its brake closed, and a state that says so. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class StoppedDrive : public Fault {
 public:
  StoppedDrive(const Making& making, bus::DriveState says) noexcept : Fault(making), says_(says) {}

  void OnActuation(Actuation& act, const Moment&) noexcept override {
    target().ForEachJoint(act.dof(), [&](int joint) {
      act.torque_Nm[joint] = 0.0;
      act.brakes_closed |= 1U << static_cast<unsigned>(joint);
    });
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    target().ForEachJoint(m.dof, [&](int joint) {
      m.joints[static_cast<std::size_t>(joint)].state = says_;
      m.joints[static_cast<std::size_t>(joint)].torque_Nm = 0.0;
    });
  }

 private:
  bus::DriveState says_;
};

}  // namespace reed::plant
