// Frames name another cycle than theirs. RT: safe.
#include "reed/plant/faults/altered.h"
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class ClockJumpFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    for (bus::Frame& frame : frames)
      if (Hits(frame)) frame = Altered(frame, {.cycles = static_cast<int>(size())});
  }
};

}  // namespace

const Kind kClockJump{"clock_jump",
                      Seat::kNode | Seat::kWrenchFrame | Seat::kSyncFrame,
                      "cycles",
                      3,
                      -1000000.0,
                      1000000.0,
                      false,
                      "frames name another cycle than theirs",
                      &Make<ClockJumpFault>};

}  // namespace reed::plant
