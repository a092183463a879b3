// Frames have another length. RT: safe.
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class WrongLengthFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    for (bus::Frame& frame : frames)
      if (Hits(frame)) frame.size = frame.size > 8 ? 8 : 6;
  }
};

}  // namespace

const Kind kWrongLength{"wrong_length",         kFrames, "", 0, 0, 0, false, "frames have another length",
                        &Make<WrongLengthFault>};

}  // namespace reed::plant
