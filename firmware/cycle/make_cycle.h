// The cycle for an arm's number of joints. RT: set-up only.
#pragma once

#include <memory>

#include "reed/bus/codec/codec.h"
#include "reed/bus/transport/transport.h"
#include "reed/config/controller/controller_config.h"
#include "reed/core/law/external_law.h"
#include "reed/firmware/cycle/cycle_base.h"

namespace reed {

/// For 2 … 8 joints. start_wanted: the operator's wish to open the brakes. law: from outside; nullptr: the scenario's.
/// codec: of the drives; nullptr: of bus/reed.dbc.
/// Throws std::runtime_error with one line.
std::unique_ptr<CycleBase> MakeCycle(const ControllerConfig& scenario, bus::Transport& transport,
                                     bool start_wanted, const strategy::ExternalLaw* law = nullptr,
                                     std::unique_ptr<bus::ControllerCodec> codec = nullptr);

}  // namespace reed
