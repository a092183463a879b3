// When torque may flow, as one table. Pure functions, nothing remembered here. RT: safe.
#pragma once

#include <array>

#include "reed/bus/codec/messages.h"

namespace reed::plant {

/// Below this speed a motor counts as at rest: a brake may open.
inline constexpr double kRestSpeed_radps = 0.02;

/// Only the *change* from one request to the next moves a drive up; a stream of equal requests moves nothing.
struct DriveTransition {
  bus::DriveState from;
  bus::DriveRequest previous;
  bus::DriveRequest request;
  bool needs_rest;
  bus::DriveState to;
};

inline constexpr std::array kWaysUp{
    DriveTransition{bus::DriveState::kOff, bus::DriveRequest::kOff, bus::DriveRequest::kReady, false,
                    bus::DriveState::kReady},
    DriveTransition{bus::DriveState::kReady, bus::DriveRequest::kReady, bus::DriveRequest::kEnable, true,
                    bus::DriveState::kEnabled},
};

/// The state after one valid command. A lower request acts at once. Only a request for off ends braked, so the
/// way back to torque is off, ready, enable, each requested again. Fault ends by a
/// restart of the drives.
constexpr bus::DriveState AfterCommand(bus::DriveState state, bus::DriveRequest previous,
                                       bus::DriveRequest request, bool at_rest) noexcept {
  if (state == bus::DriveState::kFault) return state;
  if (request == bus::DriveRequest::kOff) return bus::DriveState::kOff;
  if (state == bus::DriveState::kEnabled && request == bus::DriveRequest::kReady)
    return bus::DriveState::kReady;
  for (const DriveTransition& t : kWaysUp) {
    if (t.from == state && t.previous == previous && t.request == request && (at_rest || !t.needs_rest))
      return t.to;
  }
  return state;
}

/// The state after commands stopped for longer than the drives wait.
constexpr bus::DriveState AfterSilence(bus::DriveState state) noexcept {
  const bool armed = state == bus::DriveState::kReady || state == bus::DriveState::kEnabled;
  return armed ? bus::DriveState::kBraked : state;
}

/// Brakes are open and torque flows in one state only.
constexpr bool BrakesClosed(bus::DriveState state) noexcept { return state != bus::DriveState::kEnabled; }

constexpr const char* Name(bus::DriveState state) noexcept {
  switch (state) {
    case bus::DriveState::kOff:
      return "off";
    case bus::DriveState::kReady:
      return "ready";
    case bus::DriveState::kEnabled:
      return "enabled";
    case bus::DriveState::kBraked:
      return "braked";
    case bus::DriveState::kFault:
      return "fault";
  }
  return "unknown";
}

}  // namespace reed::plant
