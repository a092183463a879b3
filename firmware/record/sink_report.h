// How one output of the recorder fared, for the end of the run.
#pragma once

#include <cstdint>
#include <string>

namespace reed::telemetry {

struct SinkReport {
  std::string name;          // path of a file, URL of LCM; empty: switched off
  std::int64_t written = 0;  // messages or lines that the kernel took
  std::int64_t lost = 0;     // messages or lines that it did not
  std::string problem;       // the first error, with the fix where there is one; empty: none
};

}  // namespace reed::telemetry
