// A drive's processor restarts. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class ResetFault final : public Fault {
 public:
  explicit ResetFault(const Making& making) : target_(making.target), boot_s_(making.size) {}

  void OnActuation(Actuation& act, const Moment&) noexcept override {
    for (int joint = 0; joint < static_cast<int>(act.torque_Nm.size()); ++joint) {
      if (!target_.Has(joint)) continue;
      act.torque_Nm[joint] = 0.0;
      act.brakes_closed |= 1U << static_cast<unsigned>(joint);
    }
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    for (int joint = 0; joint < m.dof; ++joint) {
      if (!target_.Has(joint)) continue;
      m.joints[static_cast<std::size_t>(joint)].state = bus::DriveState::kOff;
      m.joints[static_cast<std::size_t>(joint)].torque_Nm = 0.0;
    }
  }
  void OnSent(FrameBatch& frames, const Moment& at) noexcept override {
    const bool boots = at.since_s() < boot_s_;
    if (boots) frames.RemoveIf([this](const bus::Frame& frame) { return target_.Carries(frame.id); });
    for (bus::Frame& frame : frames)
      if (target_.Carries(frame.id)) Reprotect(frame, counter_);
    if (!boots) ++counter_;
  }

 private:
  Target target_;
  double boot_s_;
  std::uint8_t counter_ = 0;
};

}  // namespace

const Kind kReset{"reset",
                  static_cast<std::uint32_t>(Seat::kNode),
                  "s",
                  0.02,
                  0,
                  10,
                  true,
                  "the node starts anew: silent for size, then off, its counter from zero, its brake closed",
                  &Make<ResetFault>};

}  // namespace reed::plant
