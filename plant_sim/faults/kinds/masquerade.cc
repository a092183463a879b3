// Somebody else sends the frame first, well protected, with another value. RT: safe.
#include "reed/plant/faults/altered.h"
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class MasqueradeFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    batch_.Clear();
    for (const bus::Frame& frame : frames) {
      if (Hits(frame)) batch_.Add(Altered(frame, {.value = size()}));
      batch_.Add(frame);
    }
    frames = batch_;
  }
  FrameBatch batch_;
};

}  // namespace

const Kind kMasquerade{"masquerade",
                       Seat::kJointFrame | Seat::kWrenchFrame | Seat::kCommandFrame,
                       "unit of the frame's first value",
                       0.1,
                       -1000.0,
                       1000.0,
                       false,
                       "somebody else sends the frame first, well protected, with another value",
                       &Make<MasqueradeFault>};

}  // namespace reed::plant
