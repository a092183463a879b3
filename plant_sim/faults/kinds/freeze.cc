// A drive's processor hangs while its hardware goes on. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/held_values.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class FreezeFault final : public Fault {
 public:
  using Fault::Fault;

  void OnActuation(Actuation& act, const Moment& at) noexcept override {
    if (act.braked) return;
    target().ForEachJoint(act.dof(), [&](int joint) {
      act.torque_Nm[joint] = held_.Of(static_cast<std::size_t>(joint), act.torque_Nm[joint], at.since == 0);
    });
  }
  void OnSent(FrameBatch& frames, const Moment&) noexcept override {
    const std::uint32_t first = bus::layout::kJointState[0].id;
    for (bus::Frame& frame : frames) {
      if (!Hits(frame)) continue;
      bus::Frame& old = old_[frame.id - first];
      if (old.id == 0) old = frame;
      frame = old;
    }
  }

 private:
  HeldValues held_;
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
