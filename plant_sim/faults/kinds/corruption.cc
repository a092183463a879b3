// Bits of frames are wrong, and so is their CRC. RT: safe.
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class CorruptionFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment& at, bool) noexcept override {
    for (bus::Frame& frame : frames)
      if (Hits(frame))
        frame.data[3U + static_cast<unsigned>(at.since) % 5U] ^=
            static_cast<std::uint8_t>(1U << (static_cast<unsigned>(at.since) % 8U));
  }
};

}  // namespace

const Kind kCorruption{
    "corruption",          kFrames, "", 0, 0, 0, false, "bits of frames are wrong, and so is their CRC",
    &Make<CorruptionFault>};

}  // namespace reed::plant
