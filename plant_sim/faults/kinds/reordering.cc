// Frames arrive in the opposite order. RT: safe.
#include <algorithm>

#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class ReorderingFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    std::reverse(frames.begin(), frames.end());
  }
};

}  // namespace

const Kind kReordering{"reordering",
                       static_cast<std::uint32_t>(Seat::kBus),
                       "",
                       0,
                       0,
                       0,
                       false,
                       "frames arrive in the opposite order",
                       &Make<ReorderingFault>};

}  // namespace reed::plant
