// The simulated arm as one participant of the bus; the two clocks differ in when physics happens
// (lockstep_endpoint.h, realtime_endpoint.h). RT: safe while no controller restarts and nothing fails.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "reed/plant/endpoint/bus_port.h"
#include "reed/plant/endpoint/outcome.h"
#include "reed/plant/endpoint/robot.h"
#include "reed/plant/faults/injector.h"

namespace reed::plant {

class Endpoint {
 public:
  /// `transport`, `body` and `recorder` outlive the endpoint.
  /// codec: of the drives; nullptr: of bus/reed.dbc.
  Endpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body, RecordSink& recorder,
           std::unique_ptr<bus::ArmCodec> codec = nullptr);
  virtual ~Endpoint() = default;

  /// Waits for frames until `deadline_ns` (CLOCK_MONOTONIC) and does what they ask. True when any frame was
  /// of use.
  bool Poll(std::int64_t deadline_ns);

  Outcome outcome() const noexcept { return outcome_; }
  /// One line for people when the outcome is a failure.
  const std::string& failure() const noexcept { return failure_; }
  const Robot& robot() const noexcept { return robot_; }
  std::int64_t syncs() const noexcept { return syncs_; }
  std::uint64_t rejected() const noexcept { return port_.rejected() + refused_commands_; }

 protected:
  virtual void Handle(std::span<const Incoming> incoming) = 0;

  /// Common to both clocks: layout check, restart, stamp. False: this SYNC must not be answered.
  bool Accept(const Incoming& sync, std::int64_t utime);
  /// Sensors, answer, telemetry, all of this instant.
  void Sample(std::uint32_t cycle, const HostPauses& host = {});
  /// After every advance: a body that diverged ends the simulation.
  void CheckHealth();
  void CountRefusedCommand() noexcept { ++refused_commands_; }

  double period_s_;
  std::uint32_t shape_every_cycles_;
  double timeout_periods_;
  /// The last Poll took frames off the bus; when none of them was of use, they were somebody else's.
  bool heard_others() const noexcept { return port_.received() > 0; }
  Robot& mutable_robot() noexcept { return robot_; }
  Journal& journal() noexcept { return journal_; }

 private:
  void Fail(Outcome outcome, const std::string& line);
  /// Faults of the scenario, on what the sensors say now.
  void Disturb(Measurement& measurement) noexcept;
  /// Once.
  void TellOfAnotherArm() noexcept;

  ArmBody& body_;
  std::unique_ptr<Injector> faults_;  // null: none
  Journal journal_;
  Robot robot_;
  BusPort port_;
  Outcome outcome_ = Outcome::kRunning;
  std::string failure_;
  bool told_of_another_arm_ = false;
  std::int64_t syncs_ = 0;
  std::int64_t first_cycle_;  // of the run
  std::int64_t count_ = 0;    // number of the last SYNC
  std::uint64_t refused_commands_ = 0;
};

}  // namespace reed::plant
