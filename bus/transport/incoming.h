// The verdict on one received datagram, before anybody looks at the frame's content. Plain data. RT: safe.
#pragma once

#include <cstdint>

namespace reed::bus {

/// What a datagram turned out to be.
enum class Incoming : std::uint8_t {
  kFrame,      // a CAN FD data frame, written to `out`
  kNotForUs,   // our own, or from another machine: dropped, not counted
  kForeignId,  // an identifier that is not in the DBC: dropped and counted, as a CAN controller's filter would
  kMalformed,   // no CAN FD data frame of the format
  kErrorFrame,  // a CAN controller reported an error
  kBusOff,      // a CAN controller gave up: the bus is lost, and an arm must not wake up if it comes back
};

}  // namespace reed::bus
