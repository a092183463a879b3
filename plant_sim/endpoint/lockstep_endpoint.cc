#include "reed/plant/endpoint/lockstep_endpoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reed::plant {
LockstepEndpoint::LockstepEndpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body,
                                   RecordSink& recorder, std::unique_ptr<bus::ArmCodec> codec)
    : Endpoint(config, transport, body, recorder, std::move(codec)), rate_hz_(config.timing.rate_hz) {}

void LockstepEndpoint::Handle(std::span<const Incoming> incoming) {
  for (const Incoming& in : incoming) {
    if (outcome() != Outcome::kRunning) return;
    if (in.kind == Incoming::Kind::kSync) {
      OnSync(in);
    } else {
      OnCommand(in.command);
    }
  }
}

void LockstepEndpoint::OnSync(const Incoming& sync) {
  const std::uint32_t cycle = sync.sync.cycle;
  if (!Accept(sync, std::llround(static_cast<double>(sync.count) * 1e6 / rate_hz_))) return;
  if (sync.new_controller) {
    waiting_.reset();
  } else {
    const std::uint32_t lost = std::min(cycle - cycle_ - 1, kMaxGapCycles);
    for (std::uint32_t i = 0; i < lost; ++i) Step();
  }
  cycle_ = cycle;
  Sample(cycle);
  Step();
}

/// Only the answer to the present SYNC counts: what comes later than that came too late, on any machine
/// alike.
void LockstepEndpoint::OnCommand(const bus::CommandMessage& command) {
  if (syncs() > 0 && command.cycle == cycle_) {
    waiting_ = command;
  } else {
    CountRefusedCommand();
  }
}

void LockstepEndpoint::Step() {
  Robot& robot = mutable_robot();
  if (waiting_ && !robot.Command(*waiting_)) {
    CountRefusedCommand();
    waiting_.reset();
  }
  if (!waiting_) robot.Silence(1.0);
  waiting_.reset();
  robot.Advance(period_s_);
  CheckHealth();
}

}  // namespace reed::plant
