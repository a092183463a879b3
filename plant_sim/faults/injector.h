// All faults of a run, in the one place where they act: between the simulated robot and its bus port. The endpoint mounts drives
// and sensors on body() and the port on transport(); without faults there is no injector. RT: safe after the constructor, except
// Reset.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "reed/bus/transport/transport.h"
#include "reed/config/plant/plant_config.h"
#include "reed/plant/dynamics/arm_body.h"
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/trigger.h"
#include "reed/plant/sensor/velocity_filter.h"

namespace reed::plant {

/// A fault began or ended.
struct FaultChange {
  std::size_t fault = 0;  // its place in the configuration
  const char* id = "";
  const char* kind = "";
  const char* target = "";
  bool begins = false;
};

class Injector {
 public:
  /// Nothing where the configuration has no fault. body and transport outlive it. Throws ConfigError.
  static std::unique_ptr<Injector> For(const PlantConfig& config, ArmBody& body, bus::Transport& transport);
  Injector(std::vector<FaultConfig> faults, const PlantConfig& config, ArmBody& body,
           bus::Transport& transport);
  ~Injector();
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;

  ArmBody& body() noexcept;
  bus::Transport& transport() noexcept;

  /// As after power-up.
  void Reset();
  /// Of one cycle, counted from the run's first: decides which faults act from here on, and changes what the sensors say.
  void Step(std::int64_t cycle, double time_s, double enabled_for_s, bus::DriveState drives,
            Measurement& m) noexcept;
  /// Since they were last asked for; valid until the next Step.
  std::span<const FaultChange> TakeChanges() noexcept {
    return std::span(changes_).first(std::exchange(num_changes_, 0));
  }

 private:
  class Body;
  class Wire;
  struct Entry;

  Scene Look(std::int64_t cycle, double enabled_for_s, bus::DriveState drives) noexcept;
  /// Drives make the speed of the position: an encoder's error is in both.
  void FollowEncoders(Measurement& m, double dt_s) noexcept;
  void KeepSpeeds(Measurement& m) noexcept;
  void NoteSync() noexcept;
  void Decide(Entry& entry, bool acts) noexcept;
  template <typename Call>
  void ForActing(bool pending_too, Call call) noexcept;

  std::vector<FaultConfig> configs_;
  std::int64_t seed_;
  double period_s_, rate_hz_, filter_hz_;
  std::vector<Entry> entries_;
  std::vector<FaultChange> changes_;
  std::size_t num_changes_ = 0;
  std::vector<bool> begun_;
  std::vector<VelocityFilter> speeds_;  // of joints whose encoder may be faulty
  std::uint32_t encoders_ = 0;          // bits of them
  double sampled_s_ = 0.0;
  bool fresh_ = true;
  bool contact_ = false, braked_ = true;
  std::int64_t cycle_ = 0;
  std::unique_ptr<Body> body_;
  std::unique_ptr<Wire> wire_;
};

}  // namespace reed::plant
