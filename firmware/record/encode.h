// Snapshot to LCM messages, encoded into a buffer that the encoder owns. For an ordinary thread; allocates
// only until its vectors have grown to the run's number of joints. RT: not for the loop.
#pragma once

#include <array>
#include <cstdint>
#include <reed/adaptation_t.hpp>
#include <reed/bus_t.hpp>
#include <reed/control_t.hpp>
#include <reed/event_t.hpp>
#include <reed/histogram_t.hpp>
#include <reed/law_names_t.hpp>
#include <reed/law_t.hpp>
#include <reed/measured_t.hpp>
#include <reed/run_t.hpp>
#include <reed/timing_t.hpp>
#include <string>
#include <vector>

#include "reed/firmware/snapshot/snapshot.h"
#include "reed/telemetry/message.h"

namespace reed::telemetry {

class MessageEncoder {
 public:
  Bytes Measured(const Snapshot& snapshot, std::int64_t utime);
  Bytes Control(const Snapshot& snapshot, std::int64_t utime);
  Bytes Adaptation(const Snapshot& snapshot, std::int64_t utime);
  Bytes Timing(const Snapshot& snapshot, std::int64_t utime);
  Bytes Law(const Snapshot& snapshot, std::int64_t utime);
  /// @throws std::length_error if the names do not fit one datagram
  Bytes LawNames(const std::vector<std::string>& names, std::int64_t utime);
  Bytes Bus(const BusCounters& counters, std::int64_t cycle, std::int64_t utime);
  /// @param index  of the snapshot's events
  Bytes Event(const Snapshot& snapshot, int index, const char* text, std::int64_t utime);
  Bytes Histogram(const reed::histogram_t& histogram);
  /// @throws std::length_error if its strings do not fit one datagram
  Bytes Run(const reed::run_t& run);

 private:
  template <typename Message>
  Bytes Encode(const Message& message);

  reed::measured_t measured_;
  reed::control_t control_;
  reed::adaptation_t adaptation_;
  reed::timing_t timing_;
  reed::law_t law_;
  reed::bus_t bus_;
  reed::event_t event_;
  std::array<std::uint8_t, kMaxMessageBytes> buffer_;
};

}  // namespace reed::telemetry
