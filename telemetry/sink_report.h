// How one output of a recorder fared, for the end of the run.
#pragma once

#include <cstdint>
#include <string>

namespace reed::telemetry {

struct SinkReport {
  std::string name;          // path of a file, URL of LCM; empty: switched off
  std::int64_t written = 0;  // messages or lines that the kernel took
  std::int64_t lost = 0;     // messages or lines that it did not
  std::string problem;       // the first error, with the fix where there is one; empty: none

  /// One line of what went wrong and how many of `what` it cost.
  std::string Loss(const char* what) const {
    return problem + " (" + std::to_string(lost) + " " + what + " lost, " + std::to_string(written) +
           " written)";
  }
};

}  // namespace reed::telemetry
