// The reading's error grows with time. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class DriftFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment& at) noexcept override {
    return value + size() * at.since_s();
  }
};

}  // namespace

const Kind kDrift{"drift",
                  kSignals,
                  "unit of the signal per s",
                  0.05,
                  -10000.0,
                  10000.0,
                  false,
                  "the reading's error grows with time",
                  &Make<DriftFault>};

}  // namespace reed::plant
