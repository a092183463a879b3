// The bus is blocked. What waited comes at its end. RT: safe.
#include "reed/plant/faults/held_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class BlockingFault final : public HeldFault {
  using HeldFault::HeldFault;
  std::int64_t Until(const Moment&) noexcept override { return kEver; }
};

}  // namespace

const Kind kBlocking{"blocking",
                     static_cast<std::uint32_t>(Seat::kBus),
                     "",
                     0,
                     0,
                     0,
                     true,
                     "the bus is blocked, and what was sent comes at the end at once",
                     &Make<BlockingFault>};

}  // namespace reed::plant
