// A CAN controller is bus-off: its node neither sends nor receives. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/held_values.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class BusOffFault final : public Fault {
 public:
  using Fault::Fault;

  void OnReceived(FrameBatch& frames, const Moment&) noexcept override { Remove(frames); }
  void OnSent(FrameBatch& frames, const Moment&) noexcept override { Remove(frames); }
  void OnActuation(Actuation& act, const Moment& at) noexcept override {
    if (target().seat != Seat::kNode || act.braked) return;
    target().ForEachJoint(act.dof(), [&](int joint) {
      const double held = held_.Of(static_cast<std::size_t>(joint), act.torque_Nm[joint], at.since == 0);
      const bool brakes = at.since >= size();
      act.torque_Nm[joint] = brakes ? 0.0 : held;
      if (brakes) act.brakes_closed |= 1U << static_cast<unsigned>(joint);
    });
  }

 private:
  void Remove(FrameBatch& frames) noexcept {
    frames.RemoveIf([this](const bus::Frame& frame) { return Hits(frame); });
  }

  HeldValues held_;
};

}  // namespace

const Kind kBusOff{"bus_off",
                   Seat::kNode | Seat::kBus,
                   "cycles until its drive brakes",
                   20,
                   1,
                   1000,
                   true,
                   "the node neither sends nor receives; its drive keeps the last torque and then brakes",
                   &Make<BusOffFault>};

}  // namespace reed::plant
