// Time by CLOCK_MONOTONIC. The arm moves on its own; SYNC only samples it and commands act when they arrive,
// so that a late controller really hurts; a machine that runs neither program does not, the clock stands
// still for it and the answer says so. The plant's clock starts with a controller's first SYNC. Physics is
// caught up with when a frame arrives, twice per cycle: waking in between would answer SYNC 30 us sooner and
// cost a core that both programs share two context switches.
#pragma once

#include <cstdint>
#include <functional>

#include "reed/plant/endpoint/endpoint.h"

namespace reed::plant {

/// Where time comes from; tests bring their own.
struct WallClock {
  std::function<std::int64_t()> monotonic_ns;
  std::function<std::int64_t()> realtime_us;
  /// How much of monotonic_ns the machine was away.
  std::function<std::int64_t()> stood_ns = [] { return std::int64_t{0}; };
  static WallClock System();
};

class WallEndpoint final : public Endpoint {
 public:
  WallEndpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body, Recorder& recorder,
               WallClock clock = WallClock::System());

 private:
  /// A machine that is this far behind gives the time up (and says so) instead of chasing it for ever.
  static constexpr std::int64_t kMaxCatchUp_ns = 250'000'000;
  /// Without a SYNC for so long there is no run of which a stall could be left out.
  static constexpr std::int64_t kControllerGone_ns = 1'000'000'000;
  /// A stall this long is worth a line; shorter ones are counted.
  static constexpr std::int64_t kWorthALine_ns = 10'000'000;

  void Handle(std::span<const Incoming> incoming) override;
  void OnSync(const Incoming& sync, std::int64_t now_ns);
  /// The arm's clock at `now_ns`: without the time in which the machine was away.
  std::int64_t ArmTime(std::int64_t now_ns);
  void OnCommand(const bus::CommandMessage& command);
  /// Physics up to the arm's `now_ns` in steps of at most plant.max_step_s.
  void CatchUp(std::int64_t now_ns);

  WallClock clock_;
  std::int64_t max_step_ns_;
  std::int64_t integrated_ns_ = 0;                         // instant of the arm's state on its own clock
  std::int64_t stood_ns_ = 0;                              // clock_.stood_ns() as known so far
  std::int64_t answered_ns_ = 0, stood_at_answer_ns_ = 0;  // both clocks at the last answer
  Standstill standstill_;
  std::int64_t real_minus_monotonic_us_ = 0;  // one reading of the clock serves both times of a cycle
  std::uint32_t cycle_ = 0;
};

}  // namespace reed::plant
