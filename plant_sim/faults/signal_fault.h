// A fault of one signal: what the sensor says becomes something else. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class SignalFault : public Fault {
 public:
  explicit SignalFault(const Making& making)
      : target_(making.target), size_(making.size), announced_(making.config.announced) {}

  void OnMeasurement(Measurement& m, const Moment& at) noexcept override {
    if (target_.seat == Seat::kForce) {
      for (int axis = 0; axis < 3; ++axis)
        if (target_.axis < 0 || target_.axis == axis)
          m.wrench.force_N[axis] = Changed(static_cast<std::size_t>(axis), m.wrench.force_N[axis], at);
      if (announced_) m.wrench.saturated = true;
      return;
    }
    for (int joint = 0; joint < m.dof; ++joint) {
      if (!target_.Has(joint)) continue;
      bus::JointStateMessage& state = m.joints[static_cast<std::size_t>(joint)];
      double& value = target_.seat == Seat::kEncoder ? state.position_rad
                      : target_.seat == Seat::kSpeed ? state.velocity_radps
                                                     : state.torque_Nm;
      value = Changed(static_cast<std::size_t>(joint), value, at);
      if (announced_) state.state = bus::DriveState::kFault;
    }
  }

 protected:
  static constexpr std::size_t kChannels = kMaxJoints;  // joints, or axes

  virtual double Changed(std::size_t channel, double value, const Moment& at) noexcept = 0;
  double size() const noexcept { return size_; }

 private:
  Target target_;
  double size_;
  bool announced_;
};

}  // namespace reed::plant
