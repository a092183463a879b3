// The reading has more noise: normal, white. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class NoiseFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment& at) noexcept override {
    return value + size() * at.random.Normal();
  }
};

}  // namespace

const Kind kNoise{"noise",
                  kSignals,
                  "unit of the signal, standard deviation",
                  0.01,
                  0,
                  10000.0,
                  false,
                  "the reading has more noise: normal, white",
                  &Make<NoiseFault>};

}  // namespace reed::plant
