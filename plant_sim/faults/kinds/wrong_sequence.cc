// The counters of frames jump. RT: safe.
#include "reed/bus/codec/reprotect.h"
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class WrongSequenceFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment& at, bool) noexcept override {
    for (bus::Frame& frame : frames)
      if (Hits(frame))
        bus::Reprotect(frame, static_cast<std::uint8_t>(bus::CounterOf(frame) +
                                                        (at.since + 1) * static_cast<int>(size())));
  }
};

}  // namespace

const Kind kWrongSequence{"wrong_sequence",
                          kSentFrames | Seat::kCommandFrame,
                          "1",
                          30,
                          1,
                          254,
                          false,
                          "the counters of frames jump",
                          &Make<WrongSequenceFault>};

}  // namespace reed::plant
