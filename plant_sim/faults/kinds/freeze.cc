// A drive's processor hangs while its hardware goes on. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/held_torque.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class FreezeFault final : public Fault {
 public:
  explicit FreezeFault(const Making& making) : target_(making.target) {}

  void OnActuation(Actuation& act, const Moment& at) noexcept override {
    for (int joint = 0; joint < static_cast<int>(act.torque_Nm.size()) && !act.braked; ++joint) {
      if (!target_.Has(joint)) continue;
      act.torque_Nm[joint] = held_.Of(joint, act.torque_Nm[joint], at.since == 0);
    }
  }
  void OnSent(FrameBatch& frames, const Moment&) noexcept override {
    const std::uint32_t first = bus::layout::kJointState[0].id;
    for (bus::Frame& frame : frames) {
      if (!target_.Carries(frame.id)) continue;
      bus::Frame& old = old_[frame.id - first];
      if (old.id == 0) old = frame;
      frame = old;
    }
  }

 private:
  Target target_;
  HeldTorque held_;
  std::array<bus::Frame, kMaxJoints> old_{};
};

}  // namespace

const Kind kFreeze{"freeze",
                   static_cast<std::uint32_t>(Seat::kNode),
                   "",
                   0,
                   0,
                   0,
                   true,
                   "the node hangs: the same frame, the same torque",
                   &Make<FreezeFault>};

}  // namespace reed::plant
