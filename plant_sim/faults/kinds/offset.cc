// The reading has a constant error. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class OffsetFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment&) noexcept override { return value + size(); }
};

}  // namespace

const Kind kOffset{"offset",
                   kSignals,
                   "unit of the signal",
                   0.05,
                   -10000.0,
                   10000.0,
                   false,
                   "the reading has a constant error",
                   &Make<OffsetFault>};

}  // namespace reed::plant
