// Lockstep with a link between controller and arm: time still goes by SYNC, but within a period the joints sample when the SYNC
// is there, and the drives follow a command from the instant on at which they hear it. Without a wire a command takes one period,
// as in lockstep_endpoint.h, and what the link adds. RT: as Endpoint.
#pragma once

#include <cstdint>
#include <memory>

#include "reed/plant/endpoint/endpoint.h"
#include "reed/plant/link/link_transport.h"

namespace reed::plant {

class TimedEndpoint final : public Endpoint {
 public:
  /// body and sink outlive it, and the bus that `bus` holds.
  TimedEndpoint(const PlantConfig& config, std::unique_ptr<LinkTransport> bus, ArmBody& body,
                RecordSink& sink);

 private:
  void Handle(std::span<const Incoming> incoming) override;
  void OnSync(const Incoming& sync);
  /// With the commands that are heard on the way; one that is heard at `to_ns` acts from there on.
  void AdvanceTo(std::int64_t to_ns);
  void Follow(const bus::CommandMessage& command);

  std::unique_ptr<LinkTransport> bus_;
  double rate_hz_;
  std::int64_t period_ns_;
  double computed_answers_us_, computed_command_us_;
  std::uint32_t cycle_ = 0;
  std::int64_t count_ = 0;     // of the last SYNC
  std::int64_t cycle_ns_ = 0;  // its cycle's start
  std::int64_t now_ns_ = 0;    // of the arm
};

/// The arm in lockstep, with a link where the configuration has one. bus, body and sink outlive it.
std::unique_ptr<Endpoint> MakeLockstepEndpoint(const PlantConfig& config, bus::Transport& bus, ArmBody& body,
                                               RecordSink& sink);

}  // namespace reed::plant
