// Time by CLOCK_MONOTONIC. The arm moves on its own: SYNC only samples it, and commands act when they arrive. A
// late controller meets an arm that has moved on. The arm's clock is held in a host pause, when the host runs
// neither program. It starts with a controller's first SYNC. Physics is caught up with when a frame arrives,
// twice per cycle: waking in between would answer SYNC 30 us sooner and cost a core that both programs share
// two context switches.
#pragma once

#include <cstdint>
#include <functional>

#include "reed/plant/endpoint/endpoint.h"

namespace reed::plant {

/// Where time comes from; tests bring their own.
struct EndpointClock {
  std::function<std::int64_t()> monotonic_ns;
  std::function<std::int64_t()> realtime_us;
  /// Sum of the host pauses so far.
  std::function<std::int64_t()> paused_ns = [] { return std::int64_t{0}; };
  static EndpointClock System();
};

class RealtimeEndpoint final : public Endpoint {
 public:
  RealtimeEndpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body, RecordSink& recorder,
                   EndpointClock clock = EndpointClock::System(),
                   std::unique_ptr<bus::ArmCodec> codec = nullptr);

 private:
  /// A simulation that is this far behind gives the time up (and says so) instead of chasing it for ever.
  static constexpr std::int64_t kMaxCatchUp_ns = 250'000'000;
  /// Frames of no use are no reason to integrate before so much has passed.
  static constexpr std::int64_t kIdle_ns = 50'000'000;
  /// Without a SYNC for so long there is no run in which a pause could matter.
  static constexpr std::int64_t kControllerGone_ns = 1'000'000'000;
  /// A pause this long is worth a line; shorter ones are counted.
  static constexpr std::int64_t kWorthALine_ns = 10'000'000;

  void Handle(std::span<const Incoming> incoming) override;
  void OnSync(const Incoming& sync, std::int64_t now_ns);
  /// The arm's clock at `now_ns`: without the host pauses.
  std::int64_t ArmTime(std::int64_t now_ns);
  void OnCommand(const bus::CommandMessage& command);
  /// Physics up to the arm's `now_ns` in steps of at most plant.max_step_s.
  void CatchUp(std::int64_t now_ns);

  EndpointClock clock_;
  std::int64_t max_step_ns_;
  std::int64_t integrated_ns_ = 0;  // instant of the arm's state on its own clock
  std::int64_t paused_ns_ = 0;      // clock_.paused_ns() as known so far
  std::int64_t answered_ns_ = 0;    // the last SYNC
  HostPauses host_;
  std::int64_t real_minus_monotonic_us_ = 0;  // one reading of the clock serves both times of a cycle
  std::uint32_t cycle_ = 0;
};

}  // namespace reed::plant
