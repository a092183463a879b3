// Frames carry the identifier of another one. RT: safe.
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class IncorrectAddressingFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool) noexcept override {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      bus::Frame& frame = frames.begin()[i];
      if (Hits(frame)) frame.id = frame.id == kFirst ? kFirst + 1 : kFirst;
    }
  }
  static constexpr std::uint32_t kFirst = bus::layout::kJointState[0].id;
};

}  // namespace

const Kind kIncorrectAddressing{"incorrect_addressing",
                                kSentFrames,
                                "",
                                0,
                                0,
                                0,
                                true,
                                "frames carry the identifier of another one",
                                &Make<IncorrectAddressingFault>};

}  // namespace reed::plant
