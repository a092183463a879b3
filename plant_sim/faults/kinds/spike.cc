// One reading in ten is far off. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class SpikeFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment& at) noexcept override {
    return at.since % 10 == 0 ? value + size() : value;
  }
};

}  // namespace

const Kind kSpike{"spike",
                  kSignals,
                  "unit of the signal",
                  0.2,
                  -10000.0,
                  10000.0,
                  false,
                  "one reading in ten is far off",
                  &Make<SpikeFault>};

}  // namespace reed::plant
