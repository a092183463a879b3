// The codec's share of one cycle of a5: SYNC and command out, five states and the wrench in, E2E both ways.
// `reed_bench_codec N` runs N plain cycles instead: callgrind counts those.
#include <cstdlib>

#include "bench/stopwatch.h"
#include "bus/messages.h"

namespace reed::bench {
namespace {

class Codec {
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
  bus::Encoder controller_, plant_;
  bus::Decoder decoder_;
};

}  // namespace
}  // namespace reed::bench

int main(int argc, char** argv) {
  reed::bench::Codec codec;
  if (argc > 1) {
    for (int k = 0, end = std::atoi(argv[1]); k < end; ++k) codec.Run(k);
    return 0;
  }
  reed::bench::Print("codec_a5", reed::bench::Measure([&](int k) { codec.Run(k); }));
}
