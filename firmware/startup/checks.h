// Start-up checks, before anything moves. RT: set-up only.
#pragma once

#include <stdexcept>

#include "reed/bus/codec/codec.h"
#include "reed/bus/transport/transport.h"
#include "reed/config/controller/controller_config.h"
#include "reed/rt/program.h"

namespace reed {

/// Throws ConfigError when one cycle's frames do not fit a 1/5 Mbit/s wire at this rate and the scenario does
/// not allow it.
void RefuseWireOverload(const ControllerConfig& scenario);

/// The scenario's [timing] with every budget set: those that are 0 share what the others leave of the period.
/// Throws ConfigError when nothing is left, or when a budget is shorter than its frames take on a 1/5 Mbit/s
/// wire and the scenario does not allow it.
TimingConfig WithBudgets(const ControllerConfig& scenario);

/// Drives do not wait for a controller; throws std::runtime_error where some may be at the bus's other end.
void RefuseLockstepOnRealDrives(const bus::Transport& transport);

/// Nothing that real drives missed may be left out; throws std::runtime_error where some may be at the bus's
/// other end.
void RefuseHostPauseOnRealDrives(const bus::Transport& transport);

/// Listens for a moment; throws BusError when somebody already sends SYNC or COMMAND here.
void RefuseSecondController(bus::Transport& transport, bus::ControllerCodec& codec);

/// The bus is there but not usable: exit status 3.
class BusError : public rt::Failure {
 public:
  explicit BusError(const std::string& line) : rt::Failure(line, rt::kDied) {}
};

}  // namespace reed
