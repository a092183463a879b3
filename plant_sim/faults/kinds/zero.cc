// The reading is zero. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class ZeroFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double, const Moment&) noexcept override { return 0.0; }
};

}  // namespace

const Kind kZero{"zero", kSignals, "", 0, 0, 0, true, "the reading is zero", &Make<ZeroFault>};

}  // namespace reed::plant
