#include "reed/plant/endpoint/realtime_endpoint.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace reed::plant {

EndpointClock EndpointClock::System() {
  using namespace std::chrono;  // NOLINT(google-build-using-namespace): local to two expressions
  return {[] { return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count(); },
          [] { return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count(); }};
}

RealtimeEndpoint::RealtimeEndpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body,
                                   RecordSink& recorder, EndpointClock clock,
                                   std::unique_ptr<bus::ArmCodec> codec)
    : Endpoint(config, transport, body, recorder, std::move(codec)),
      clock_(std::move(clock)),
      max_step_ns_(std::max<std::int64_t>(1, std::llround(config.plant.max_step_s * 1e9))) {}

void RealtimeEndpoint::Handle(std::span<const Incoming> incoming) {
  const std::int64_t now_ns = clock_.monotonic_ns();
  const std::int64_t arm_ns = ArmTime(now_ns);
  if (incoming.empty() && heard_others() && arm_ns - integrated_ns_ < kIdle_ns) return;
  if (syncs() > 0) CatchUp(arm_ns);
  for (const Incoming& in : incoming) {
    if (outcome() != Outcome::kRunning) return;
    if (in.kind == Incoming::Kind::kSync) {
      OnSync(in, now_ns);
    } else {
      OnCommand(in.command);
    }
  }
}

void RealtimeEndpoint::OnSync(const Incoming& sync, std::int64_t now_ns) {
  if (sync.new_controller) real_minus_monotonic_us_ = clock_.realtime_us() - now_ns / 1000;
  if (!Accept(sync, real_minus_monotonic_us_ + now_ns / 1000)) return;
  if (sync.new_controller) integrated_ns_ = ArmTime(clock_.monotonic_ns());
  cycle_ = sync.sync.cycle;
  Sample(cycle_, host_);
  answered_ns_ = now_ns;
}

/// Read after `now_ns`: a pause between the two readings then holds the arm back, and never pushes it ahead.
std::int64_t RealtimeEndpoint::ArmTime(std::int64_t now_ns) {
  const std::int64_t paused_ns = clock_.paused_ns();
  const std::int64_t pause_ns = paused_ns - paused_ns_;
  paused_ns_ = paused_ns;
  const bool served = syncs() > 0 && now_ns - answered_ns_ - pause_ns < kControllerGone_ns;
  if (pause_ns > 0 && served) {
    const double pause_s = static_cast<double>(pause_ns) * 1e-9;
    ++host_.count;
    host_.total_s += pause_s;
    if (pause_ns >= kWorthALine_ns) {
      journal().Note(PlantEvent::kHostPause, robot().drives().state(), pause_s,
                     "host pause of %.1f ms at %.3f s; the arm's clock was held", 1e3 * pause_s,
                     robot().time_s());
    }
  }
  return now_ns - paused_ns;
}

/// A command is an answer to a SYNC of the last few periods; an older one is a stray of another controller.
void RealtimeEndpoint::OnCommand(const bus::CommandMessage& command) {
  const bool recent = syncs() > 0 && cycle_ - command.cycle < timeout_periods_;  // modulo 2^32
  if (!recent || !mutable_robot().Command(command)) CountRefusedCommand();
}

void RealtimeEndpoint::CatchUp(std::int64_t now_ns) {
  if (const std::int64_t behind_ns = now_ns - integrated_ns_; behind_ns > kMaxCatchUp_ns) {
    integrated_ns_ = now_ns - kMaxCatchUp_ns;
    const double lost_s = static_cast<double>(behind_ns - kMaxCatchUp_ns) * 1e-9;
    journal().Note(PlantEvent::kTooSlow, robot().drives().state(), lost_s,
                   "the simulation fell behind the clock and gave up %.3f s of it", lost_s);
  }
  while (integrated_ns_ < now_ns && outcome() == Outcome::kRunning) {
    const std::int64_t step_ns = std::min(now_ns - integrated_ns_, max_step_ns_);
    const double step_s = static_cast<double>(step_ns) * 1e-9;
    mutable_robot().Advance(step_s);
    mutable_robot().Silence(step_s / period_s_);
    integrated_ns_ += step_ns;
    CheckHealth();
  }
}

}  // namespace reed::plant
