// A fault of a drive's torque: what reaches the arm is not what was asked. A silent one still reports what was asked; an announced
// one reports what it delivers. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class DriveFault : public Fault {
 public:
  using Fault::Fault;

  void OnActuation(Actuation& act, const Moment& at) noexcept override {
    target().ForEachJoint(act.dof(), [&](int joint) {
      delivered_[static_cast<std::size_t>(joint)] = act.torque_Nm[joint] =
          act.braked ? 0.0 : Delivered(joint, act.torque_Nm[joint], act, at);
      acted_ = true;
    });
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    if (!announced() || !acted_) return;
    target().ForEachJoint(m.dof, [&](int joint) {
      const auto i = static_cast<std::size_t>(joint);
      m.joints[i].torque_Nm = delivered_[i];
    });
  }

 protected:
  virtual double Delivered(int joint, double asked_Nm, const Actuation& act, const Moment& at) noexcept = 0;

 private:
  bool acted_ = false;
  std::array<double, kMaxJoints> delivered_{};
};

}  // namespace reed::plant
