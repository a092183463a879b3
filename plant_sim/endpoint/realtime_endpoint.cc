#include "reed/plant/endpoint/realtime_endpoint.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace reed::plant {

WallClock WallClock::System() {
  using namespace std::chrono;  // NOLINT(google-build-using-namespace): local to two expressions
  return {[] { return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count(); },
          [] { return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count(); }};
}

WallEndpoint::WallEndpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body,
                           Recorder& recorder, WallClock clock)
    : Endpoint(config, transport, body, recorder),
      clock_(std::move(clock)),
      max_step_ns_(std::max<std::int64_t>(1, std::llround(config.plant.max_step_s * 1e9))) {}

void WallEndpoint::Handle(std::span<const Incoming> incoming) {
  const std::int64_t now_ns = clock_.monotonic_ns();
  const std::int64_t arm_ns = ArmTime(now_ns);
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

void WallEndpoint::OnSync(const Incoming& sync, std::int64_t now_ns) {
  if (sync.new_controller) real_minus_monotonic_us_ = clock_.realtime_us() - now_ns / 1000;
  if (!Accept(sync, real_minus_monotonic_us_ + now_ns / 1000)) return;
  if (sync.new_controller) integrated_ns_ = ArmTime(clock_.monotonic_ns());
  cycle_ = sync.sync.cycle;
  // Most of the time since the last answer: then the machine made the controller late, and not itself.
  standstill_.clock_stood = 2 * (stood_ns_ - stood_at_answer_ns_) > now_ns - answered_ns_;
  Sample(cycle_, standstill_);
  answered_ns_ = now_ns;
  stood_at_answer_ns_ = stood_ns_;
}

/// Read after `now_ns`: a stall between the two readings then holds the arm back, and never pushes it ahead.
std::int64_t WallEndpoint::ArmTime(std::int64_t now_ns) {
  const std::int64_t stood_ns = clock_.stood_ns();
  const std::int64_t stall_ns = stood_ns - stood_ns_;
  stood_ns_ = stood_ns;
  const bool served = syncs() > 0 && now_ns - answered_ns_ - stall_ns < kControllerGone_ns;
  if (stall_ns > 0 && served) {
    const double stall_s = static_cast<double>(stall_ns) * 1e-9;
    ++standstill_.stalls;
    standstill_.stood_s += stall_s;
    if (stall_ns >= kWorthALine_ns) {
      journal().Note(PlantEvent::kClockStood, robot().drives().state(), stall_s,
                     "the machine was away for %.1f ms at %.3f s; the arm's clock stood still", 1e3 * stall_s,
                     robot().time_s());
    }
  }
  return now_ns - stood_ns;
}

/// A command is an answer to a SYNC of the last few periods; an older one is a stray of another controller.
void WallEndpoint::OnCommand(const bus::CommandMessage& command) {
  const bool recent = syncs() > 0 && command.cycle <= cycle_ && cycle_ - command.cycle < timeout_periods_;
  if (!recent || !mutable_robot().Command(command)) CountRefusedCommand();
}

void WallEndpoint::CatchUp(std::int64_t now_ns) {
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
