// Whether another arm is on the bus already. RT: set-up only.
#pragma once

#include "reed/bus/listen/hears.h"
#include "reed/rt/program.h"

namespace reed::plant {

/// Listens for a moment, before this plant answers anybody; throws rt::Failure when a joint or a wrist answers here: the
/// controller would take whose frame comes first.
inline void RefuseSecondArm(bus::Transport& transport, bus::ControllerCodec& codec) {
  const auto of_an_arm = [](bus::MessageKind kind) {
    return kind == bus::MessageKind::kJointState || kind == bus::MessageKind::kWrench;
  };
  if (bus::Hears(transport, codec, of_an_arm))
    throw rt::Failure("another arm already answers on " + transport.kind() + ":" + transport.interface() +
                          "; end it, or choose another bus with --bus",
                      rt::kDied);
}

}  // namespace reed::plant
