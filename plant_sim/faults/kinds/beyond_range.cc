// The reading is at the end of what its frame carries. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class BeyondRangeFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double, const Moment&) noexcept override { return 1e9; }
};

}  // namespace

const Kind kBeyondRange{"beyond_range",
                        kSignals,
                        "",
                        0,
                        0,
                        0,
                        true,
                        "the reading is at the end of what its frame carries",
                        &Make<BeyondRangeFault>};

}  // namespace reed::plant
