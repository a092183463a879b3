// What one received datagram is, before the frame's content is read. Plain data. RT: safe.
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
  kBusOff,      // a CAN controller is bus-off: the bus is lost, and the arm must not move if it returns
};

}  // namespace reed::bus
