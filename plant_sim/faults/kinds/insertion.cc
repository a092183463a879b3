// A valid frame of a joint that the arm does not have. RT: safe.
#include "reed/bus/codec/messages.h"
#include "reed/plant/faults/frame_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class InsertionFault final : public FrameFault {
  using FrameFault::FrameFault;
  void Pass(FrameBatch& frames, const Moment&, bool received) noexcept override {
    if (received) return;
    frames.Add(writer_.JointState(kMaxJoints - 1, {}));
  }
  bus::FrameEncoder writer_;
};

}  // namespace

const Kind kInsertion{"insertion",
                      static_cast<std::uint32_t>(Seat::kBus),
                      "",
                      0,
                      0,
                      0,
                      false,
                      "a valid frame of a joint that the arm does not have",
                      &Make<InsertionFault>};

}  // namespace reed::plant
