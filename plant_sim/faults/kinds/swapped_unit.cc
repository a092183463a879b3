// The reading is in another unit, as degrees for radians. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class SwappedUnitFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment&) noexcept override { return size() * value; }
};

}  // namespace

const Kind kSwappedUnit{"swapped_unit",
                        kSignals,
                        "factor",
                        57.29577951308232,
                        0.0001,
                        10000.0,
                        false,
                        "the reading is in another unit, as degrees for radians",
                        &Make<SwappedUnitFault>,
                        1.0};

}  // namespace reed::plant
