// A value is wrong before its frame is protected. RT: safe.
#include "reed/plant/faults/altered.h"
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class CorruptionRightCrcFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    for (bus::Frame& frame : frames)
      if (Hits(frame)) frame = Altered(frame, {.value = size()});
  }
};

}  // namespace

const Kind kCorruptionRightCrc{"corruption_right_crc",
                               Seat::kJointFrame | Seat::kWrenchFrame | Seat::kCommandFrame,
                               "unit of the frame's first value",
                               0.2,
                               -1000.0,
                               1000.0,
                               false,
                               "a value is wrong before its frame is protected",
                               &Make<CorruptionRightCrcFault>};

}  // namespace reed::plant
