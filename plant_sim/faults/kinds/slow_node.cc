// A node computes too long. RT: safe.
#include "reed/plant/faults/held_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class SlowNodeFault final : public HeldFault {
  using HeldFault::HeldFault;
  std::int64_t Until(const Moment& at) noexcept override { return at.cycle + cycles(); }
};

}  // namespace

const Kind kSlowNode{"slow_node",
                     static_cast<std::uint32_t>(Seat::kNode),
                     "cycles",
                     1,
                     1,
                     99,
                     false,
                     "the node answers late",
                     &Make<SlowNodeFault>};

}  // namespace reed::plant
