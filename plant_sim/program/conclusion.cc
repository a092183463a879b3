#include "reed/plant/program/conclusion.h"

#include <cstdio>

namespace reed::plant {

void Say(bool quiet, const std::string& line) {
  if (quiet) return;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

int Conclude(const Endpoint& endpoint, Publisher& publisher, bool quiet) {
  const bool log_complete = publisher.Finish();
  Say(quiet, "done: " + std::to_string(endpoint.syncs()) + " cycles, " + std::to_string(endpoint.rejected()) +
                 " frames refused, " + std::to_string(publisher.dropped()) + " records dropped");
  if (!endpoint.failure().empty()) std::fprintf(stderr, "reed_plant_sim: %s\n", endpoint.failure().c_str());
  const int status = ExitStatus(endpoint.outcome());
  return status == 0 && !log_complete ? 3 : status;
}

}  // namespace reed::plant
