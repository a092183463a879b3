// The reading is late. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/signal_fault.h"

namespace reed::plant {
namespace {

class LagFault final : public SignalFault {
  using SignalFault::SignalFault;
  double Changed(std::size_t channel, double value, const Moment& at) noexcept override {
    std::array<double, kLongest>& line = line_[channel];
    if (at.since == 0) line.fill(value);
    const auto now = static_cast<std::size_t>(at.since);
    line[now % kLongest] = value;
    const auto late = static_cast<std::size_t>(size());
    return now >= late ? line[(now - late) % kLongest] : line[(now + 1) % kLongest];
  }
  static constexpr std::size_t kLongest = 100;
  std::array<std::array<double, kLongest>, kChannels> line_{};
};

}  // namespace

const Kind kLag{"lag", kSignals, "cycles", 20, 1, 99, false, "the reading is late", &Make<LagFault>};

}  // namespace reed::plant
