// The reading has the other sign. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class SwappedSignFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double value, const Moment&) noexcept override { return -value; }
};

}  // namespace

const Kind kSwappedSign{
    "swapped_sign", kSignals, "", 0, 0, 0, false, "the reading has the other sign", &Make<SwappedSignFault>};

}  // namespace reed::plant
