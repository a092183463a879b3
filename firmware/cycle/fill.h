// From the loop's own types to the plain bytes of a snapshot. Where a field comes from is said in its .lcm file, in terms
// of the arguments here. RT: safe.
#pragma once

#include <cstddef>

#include "reed/bus/codec/messages.h"
#include "reed/bus/transport/transport.h"
#include "reed/core/controller.h"
#include "reed/core/measurement.h"
#include "reed/firmware/snapshot/snapshot.h"

namespace reed::telemetry {

inline void FillEvents(const EventList& events, Snapshot& out) noexcept {
  for (const reed::Event& from : events) {
    Event to;
    to.mode = static_cast<std::int8_t>(from.mode);
    to.force_source = static_cast<std::int8_t>(from.source);
    to.code = static_cast<std::int32_t>(from.code);
    to.joint = from.joint;
    to.value = from.value;
    out.AddEvent(to);
  }
}

template <int N>
void FillMeasured(const Measurement<N>& measured, Measured& out) noexcept {
  REED_MEASURED_T(REED_SET)
}

template <int N, int P>
void FillControl(const Controller<N, P>& controller, Control& out) noexcept {
  const strategy::Decision<N>& decision = controller.decision();
  const strategy::Separated<N, P>& strategy = controller.strategy();
  REED_CONTROL_T(REED_SET)
}

template <int N, int P>
void FillAdaptation(const strategy::AdaptiveState<N, P>& adaptive, Adaptation& out) noexcept {
  REED_ADAPTATION_T(REED_SET)
}

/// What a law from outside shows; nothing for the laws of the bank.
inline void FillLaw(const strategy::ExternalLaw* law, Snapshot& out) noexcept {
  static_assert(kMaxLawValues == REED_LAW_MAX_VALUES);
  out.num_law_values = law != nullptr ? law->num_values : 0;
  for (std::int32_t i = 0; i < out.num_law_values; ++i)
    out.law_values[static_cast<std::size_t>(i)] = law->output->values[i];
}

inline void FillBus(const bus::TransportCounters& transport, const bus::DecodeCounters& decoder,
                    std::int64_t late, BusCounters& out) noexcept {
  const auto rejected = [&](bus::Reject reason) {
    return decoder.rejected[static_cast<std::size_t>(reason)];
  };
  REED_BUS_T(REED_SET)
}

}  // namespace reed::telemetry
