// Controller and plant in one process and in virtual time: the real cycle, the real plant endpoint, a wire in
// memory on which frames can be lost, changed and invented.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "reed/bus/codec/messages.h"
#include "reed/bus/transport/memory_transport.h"
#include "reed/config/schema/halves.h"
#include "reed/config/schema/scenario_file.h"
#include "reed/firmware/cycle/make_cycle.h"
#include "reed/plant/endpoint/flexible_arm_body.h"
#include "reed/plant/endpoint/lockstep_endpoint.h"
#include "reed/rt/clock.h"
#include "reed/rt/heap_guard.h"

namespace reed::test {

/// The last truth of the plant.
class LastTruth final : public plant::RecordSink {
 public:
  void Put(const plant::Record& record) noexcept override {
    if (const auto* truth = std::get_if<plant::PlantRecord>(&record)) last = *truth;
  }
  plant::PlantRecord last;
};

class SilRig {
 public:
  /// Decides about one frame on its way to the controller: false loses it, changes are allowed.
  using OnTheWay = std::function<bool(std::uint32_t cycle, bus::Frame& frame)>;

  /// Codecs: of the drives; nullptr: of bus/reed.dbc.
  explicit SilRig(const Scenario& scenario, bool enable = true,
                  std::unique_ptr<bus::ControllerCodec> controller_codec = nullptr,
                  std::unique_ptr<bus::ArmCodec> arm_codec = nullptr)
      : scenario_(scenario),
        body_(PlantHalf(scenario_)),
        endpoint_(PlantHalf(scenario_), wire_.plant, body_, truth_, std::move(arm_codec)),
        cycle_(MakeCycle(ControllerHalf(scenario_), wire_.controller, enable, nullptr,
                         std::move(controller_codec))) {
    wire_.controller.OnReceive([this] { LetPlantWork(); });
  }

  /// One cycle; what happened is in snapshot() and truth().
  CycleStatus Run(const CycleState& loop = {}) {
    snapshot_.ClearLists();
    snapshot_.cycle = number_;
    snapshot_.time_ns = rt::MonotonicClock{}.NowNs();
    const rt::HeapCount count;
    const CycleStatus status = cycle_->Run(number_, 0, loop, snapshot_);
    heap_calls_ += count.calls();
    ++number_;
    return status;
  }
  /// Until the arm has been active this long; false if it was not to be.
  bool RunActive(double seconds) {
    constexpr int kStartCycles = 1000;
    const double end_s = seconds - 0.5 / scenario_.timing.rate_hz;
    for (int waited = 0; waited < kStartCycles && mode() != mode::Mode::kActive; ++waited) Run();
    while (mode() == mode::Mode::kActive && snapshot_.control.t_s < end_s) Run();
    return mode() == mode::Mode::kActive;
  }

  mode::Mode mode() const { return cycle_->mode(); }
  protect::Reason trip() const { return cycle_->trip(); }
  TripPlace trip_place() const { return cycle_->trip_place(); }
  bool LimitActs(protect::Reason reason) const {
    return (snapshot_.control.limits & protect::LimitBit(reason)) != 0;
  }
  bool TorqueIsZero() const {
    for (const double tau : snapshot_.control.tau)
      if (tau != 0.0) return false;
    return true;
  }
  const telemetry::Snapshot& snapshot() const { return snapshot_; }
  const plant::PlantRecord& truth() const { return truth_.last; }
  const plant::DriveChain& drives() const { return endpoint_.robot().drives(); }
  std::int64_t heap_calls() const { return heap_calls_; }
  std::uint32_t cycle_number() const { return number_; }

  OnTheWay on_the_way;
  std::optional<bus::Frame> injected;  // reaches the controller in the next cycle
  bool commands_lost = false;          // on their way to the drives
  std::vector<bus::Frame> flood;       // of others, in every cycle to both programs, before their own

 private:
  void LetPlantWork() {
    const rt::HeapPause not_the_controllers;
    if (commands_lost)
      std::erase_if(wire_.plant.inbox(),
                    [](const bus::Frame& frame) { return frame.id == bus::layout::kCommand.id; });
    std::vector<bus::Frame>& of_plant = wire_.plant.inbox();
    if (flooded_ != number_) of_plant.insert(of_plant.begin(), flood.begin(), flood.end());
    endpoint_.Poll(0);
    std::vector<bus::Frame>& inbox = wire_.controller.inbox();
    if (std::exchange(flooded_, number_) != number_) inbox.insert(inbox.begin(), flood.begin(), flood.end());
    if (on_the_way) std::erase_if(inbox, [this](bus::Frame& frame) { return !on_the_way(number_, frame); });
    if (injected) inbox.insert(inbox.begin(), *injected);
    injected.reset();
  }

  Scenario scenario_;
  bus::MemoryWire wire_;
  plant::FlexibleArmBody body_;
  LastTruth truth_;
  plant::LockstepEndpoint endpoint_;
  std::unique_ptr<CycleBase> cycle_;
  telemetry::Snapshot snapshot_;
  std::uint32_t number_ = 0, flooded_ = 0;  // no flood in the first cycle
  std::int64_t heap_calls_ = 0;
};

/// The line with which a scenario is refused at set-up, or "accepted".
inline std::string Refusal(const Scenario& scenario) {
  try {
    const SilRig rig(scenario);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace reed::test
