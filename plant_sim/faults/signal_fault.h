// A fault of one signal: what the sensor says becomes something else. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class SignalFault : public Fault {
 public:
  using Fault::Fault;

  void OnMeasurement(Measurement& m, const Moment& at) noexcept override {
    if (target().seat == Seat::kForce) return OfTheWrist(m.wrench, at);
    target().ForEachJoint(m.dof, [&](int joint) {
      const auto i = static_cast<std::size_t>(joint);
      bus::JointStateMessage& state = m.joints[i];
      double& value = target().seat == Seat::kEncoder ? state.position_rad
                      : target().seat == Seat::kSpeed ? state.velocity_radps
                                                      : state.torque_Nm;
      value = Changed(i, value, at);
      if (announced()) state.state = bus::DriveState::kFault;
    });
  }

 protected:
  static constexpr std::size_t kChannels = kMaxJoints;  // joints, or axes

  virtual double Changed(std::size_t channel, double value, const Moment& at) noexcept = 0;

 private:
  void OfTheWrist(WrenchReading& wrench, const Moment& at) noexcept {
    for (int axis = 0; axis < 3; ++axis)
      if (target().axis < 0 || target().axis == axis)
        wrench.force_N[axis] = Changed(static_cast<std::size_t>(axis), wrench.force_N[axis], at);
    if (announced()) wrench.saturated = true;
  }
};

}  // namespace reed::plant
