// The cycle for an arm's number of joints. RT: set-up only.
#pragma once

#include <memory>

#include "reed/bus/transport/transport.h"
#include "reed/config/controller/controller_config.h"
#include "reed/core/law/external_law.h"
#include "reed/firmware/cycle/cycle_base.h"

namespace reed {

/// For 2 … 8 joints. start_wanted: the operator's wish to open the brakes. law: from outside; nullptr: the scenario's.
/// Throws std::runtime_error with one line.
std::unique_ptr<CycleBase> MakeCycle(const ControllerConfig& scenario, bus::Transport& transport,
                                     bool start_wanted, const strategy::ExternalLaw* law = nullptr);

}  // namespace reed
