// The reading is late. RT: safe.
#include "reed/plant/faults/delay_line.h"
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class LagFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t channel, double value, const Moment& at) noexcept override {
    return line_.Of(channel, value, at.since, size());
  }
  DelayLine<100> line_;
};

}  // namespace

const Kind kLag{"lag", kSignals, "cycles", 20, 1, 99, false, "the reading is late", &Make<LagFault>};

}  // namespace reed::plant
