// A fault of a drive's torque: what reaches the arm is not what was asked. A silent one still reports what was asked; an announced
// one reports what it delivers. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class DriveFault : public Fault {
 public:
  explicit DriveFault(const Making& making)
      : target_(making.target), size_(making.size), announced_(making.config.announced) {}

  void OnActuation(Actuation& act, const Moment& at) noexcept override {
    for (int joint = 0; joint < static_cast<int>(act.torque_Nm.size()); ++joint) {
      if (!target_.Has(joint)) continue;
      delivered_[static_cast<std::size_t>(joint)] = act.torque_Nm[joint] =
          act.braked ? 0.0 : Delivered(joint, act.torque_Nm[joint], act, at);
      acted_ = true;
    }
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    if (!announced_ || !acted_) return;
    for (int joint = 0; joint < m.dof; ++joint)
      if (target_.Has(joint))
        m.joints[static_cast<std::size_t>(joint)].torque_Nm = delivered_[static_cast<std::size_t>(joint)];
  }

 protected:
  virtual double Delivered(int joint, double asked_Nm, const Actuation& act, const Moment& at) noexcept = 0;
  double size() const noexcept { return size_; }
  const Target& target() const noexcept { return target_; }

 private:
  Target target_;
  double size_;
  bool announced_;
  bool acted_ = false;
  std::array<double, kMaxJoints> delivered_{};
};

}  // namespace reed::plant
