// The reading has coarse steps. RT: safe.
#include <cmath>

#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class CoarseFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment&) noexcept override {
    return std::nearbyint(value / size()) * size();
  }
};

}  // namespace

const Kind kCoarse{"coarse",
                   kSignals,
                   "unit of the signal",
                   0.005,
                   1e-09,
                   1000.0,
                   false,
                   "the reading has coarse steps",
                   &Make<CoarseFault>};

}  // namespace reed::plant
