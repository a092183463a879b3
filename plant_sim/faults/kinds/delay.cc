// Frames arrive late. RT: safe.
#include "reed/plant/faults/held_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class DelayFault final : public HeldFault {
  using HeldFault::HeldFault;
  std::int64_t Until(const Moment& at) noexcept override { return at.cycle + cycles(); }
};

}  // namespace

const Kind kDelay{"delay", kFrames, "cycles", 3, 1, 99, false, "frames arrive late", &Make<DelayFault>};

}  // namespace reed::plant
