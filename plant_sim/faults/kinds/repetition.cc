// The frame before the fault comes again and again. RT: safe.
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class RepetitionFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    for (bus::Frame& frame : frames) {
      if (!Hits(frame)) continue;
      bus::Frame& old = old_[frame.id % old_.size()];
      if (old.id != frame.id) old = frame;
      frame = old;
    }
  }
  std::array<bus::Frame, 1024> old_{};  // identifiers differ modulo 1024
};

}  // namespace

const Kind kRepetition{
    "repetition",          kFrames, "", 0, 0, 0, true, "the frame before the fault comes again and again",
    &Make<RepetitionFault>};

}  // namespace reed::plant
