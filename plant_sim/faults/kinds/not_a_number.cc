// The reading is not a number. RT: safe.
#include <limits>

#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class NotANumberFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t, double, const Moment&) noexcept override {
    return std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace

const Kind kNotANumber{"not_a_number",        kSignals, "", 0, 0, 0, true, "the reading is not a number",
                       &Make<NotANumberFault>};

}  // namespace reed::plant
