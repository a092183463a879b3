// Frames do not arrive. RT: safe.
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class LossFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    frames.RemoveIf([this](const bus::Frame& frame) { return Hits(frame); });
  }
};

}  // namespace

const Kind kLoss{"loss", kFrames | Seat::kNode, "", 0, 0, 0, true, "frames do not arrive", &Make<LossFault>};

}  // namespace reed::plant
