// The reading stays what it is. RT: safe.
#include "reed/plant/faults/held_values.h"
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class StuckFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t channel, double value, const Moment& at) noexcept override {
    return held_.Of(channel, value, at.since == 0);
  }
  HeldValues held_;
};

}  // namespace

const Kind kStuck{"stuck", kSignals, "", 0, 0, 0, true, "the reading stays what it is", &Make<StuckFault>};

}  // namespace reed::plant
