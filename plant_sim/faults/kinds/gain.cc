// The reading is multiplied. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class GainFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment&) noexcept override { return size() * value; }
};

}  // namespace

const Kind kGain{"gain",           kSignals, "1", 1.5, -100, 100, false, "the reading is multiplied",
                 &Make<GainFault>, 1.0};

}  // namespace reed::plant
