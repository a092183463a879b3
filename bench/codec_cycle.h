// The codec's share of one cycle of a5: SYNC and command out, five states and the wrench both ways, E2E.
#pragma once

#include "reed/bench/stopwatch.h"
#include "reed/bus/codec/messages.h"

namespace reed::bench {

class CodecCycle {
 public:
  void Run(int k) noexcept {
    const auto cycle = static_cast<std::uint32_t>(k);
    Keep(controller_.Sync({cycle}));
    for (int joint = 0; joint < 5; ++joint) {
      const double x = 1e-3 * (k % 1000) + joint;
      Keep(decoder_.Decode(plant_.JointState(
          joint, {x, -x, x, bus::DriveState::kEnabled, static_cast<std::uint8_t>(cycle & 0xFu)})));
    }
    Keep(decoder_.Decode(plant_.Wrench({cycle, {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, false})));
    Keep(controller_.Command({cycle, bus::DriveRequest::kEnable, {1.0, 2.0, 3.0, 4.0, 5.0}}));
  }

 private:
  bus::FrameEncoder controller_, plant_;
  bus::Decoder decoder_;
};

}  // namespace reed::bench
