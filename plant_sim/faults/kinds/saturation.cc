// The reading does not exceed a bound. RT: safe.
#include <algorithm>

#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class SaturationFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment&) noexcept override {
    return std::clamp(value, -size(), size());
  }
};

}  // namespace

const Kind kSaturation{"saturation",
                       kSignals,
                       "unit of the signal",
                       0.5,
                       1e-06,
                       10000.0,
                       false,
                       "the reading does not exceed a bound",
                       &Make<SaturationFault>};

}  // namespace reed::plant
