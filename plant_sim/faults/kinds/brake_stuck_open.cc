// The brake stays open, whatever its drive wants. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/stuck_brake.h"

namespace reed::plant {
namespace {

class BrakeStuckOpenFault final : public StuckBrake {
 public:
  explicit BrakeStuckOpenFault(const Making& making) : StuckBrake(making, &Actuation::brakes_open) {}
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
