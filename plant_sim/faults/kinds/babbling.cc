// A node floods the bus with frames that nobody knows. RT: safe.
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class BabblingFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool received) noexcept override {
    if (received) return;
    bus::Frame frame;
    frame.id = 0x7F0;
    frame.size = 8;
    for (int i = 0; i < static_cast<int>(size()); ++i) frames.Add(frame);
  }
};

}  // namespace

const Kind kBabbling{"babbling",
                     static_cast<std::uint32_t>(Seat::kBus),
                     "frames per cycle",
                     60,
                     1,
                     120,
                     false,
                     "a node floods the bus with frames that nobody knows",
                     &Make<BabblingFault>};

}  // namespace reed::plant
