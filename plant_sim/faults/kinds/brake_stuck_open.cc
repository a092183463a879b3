// The brake stays open, whatever its drive wants. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class BrakeStuckOpenFault final : public Fault {
 public:
  explicit BrakeStuckOpenFault(const Making& making)
      : target_(making.target), announced_(making.config.announced) {}

  void OnActuation(Actuation& act, const Moment&) noexcept override {
    for (int joint = 0; joint < static_cast<int>(act.torque_Nm.size()); ++joint)
      if (target_.Has(joint)) act.brakes_open |= 1U << static_cast<unsigned>(joint);
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    for (int joint = 0; announced_ && joint < m.dof; ++joint)
      if (target_.Has(joint)) m.joints[static_cast<std::size_t>(joint)].state = bus::DriveState::kFault;
  }

 private:
  Target target_;
  bool announced_;
};

}  // namespace

const Kind kBrakeStuckOpen{"brake_stuck_open",
                           static_cast<std::uint32_t>(Seat::kBrake),
                           "",
                           0,
                           0,
                           0,
                           true,
                           "the brake stays open",
                           &Make<BrakeStuckOpenFault>};

}  // namespace reed::plant
