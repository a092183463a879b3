// Time by SYNC. SYNC k is answered with the state at k·T as it is; then one period is integrated with the
// command that came after SYNC k−1. So the command computed in cycle k acts from SYNC k+1 on, and plant and
// controller work side by side: the same numbers on any machine, as fast as it can.
//
//   controller  SYNC k ──┐   compute k ── command k ── SYNC k+1 ──┐   compute k+1
//   plant                └ state k·T, integrate with command k−1  └ state (k+1)·T, integrate with command k
#pragma once

#include <cstdint>
#include <optional>

#include "reed/plant/endpoint/endpoint.h"

namespace reed::plant {

/// SYNCs that were lost on the way still took their period each; a larger hole is not a loss any more.
inline constexpr std::uint32_t kMaxGapCycles = 1000;

class LockstepEndpoint final : public Endpoint {
 public:
  LockstepEndpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body, RecordSink& recorder,
                   std::unique_ptr<bus::ArmCodec> codec = nullptr);

 private:
  void Handle(std::span<const Incoming> incoming) override;
  void OnSync(const Incoming& sync);
  void OnCommand(const bus::CommandMessage& command);
  /// One period with the command that waits, or with the last one and one period more of silence.
  void Step();

  double rate_hz_;
  std::uint32_t cycle_ = 0;
  std::optional<bus::CommandMessage> waiting_;
};

}  // namespace reed::plant
