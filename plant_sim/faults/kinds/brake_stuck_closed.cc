// The brake stays closed, whatever its drive wants. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/stuck_brake.h"

namespace reed::plant {
namespace {

class BrakeStuckClosedFault final : public StuckBrake {
 public:
  explicit BrakeStuckClosedFault(const Making& making) : StuckBrake(making, &Actuation::brakes_closed) {}
};

}  // namespace

const Kind kBrakeStuckClosed{"brake_stuck_closed",
                             static_cast<std::uint32_t>(Seat::kBrake),
                             "",
                             0,
                             0,
                             0,
                             true,
                             "the brake stays closed",
                             &Make<BrakeStuckClosedFault>};

}  // namespace reed::plant
