// Error frames destroy frames, which come again a cycle later. RT: safe.
#include "reed/plant/faults/held_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class ErrorFramesFault final : public HeldFault {
  using HeldFault::HeldFault;
  std::int64_t Until(const Moment& at) noexcept override {
    return at.random.Uniform() <= size() ? at.cycle + 1 : at.cycle;
  }
};

}  // namespace

const Kind kErrorFrames{"error_frames",
                        kFrames,
                        "probability",
                        0.5,
                        1e-3,
                        1,
                        false,
                        "frames are destroyed by error frames and come again a cycle later",
                        &Make<ErrorFramesFault>};

}  // namespace reed::plant
