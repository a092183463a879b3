#include "plant_sim/process/stop_signal.h"

#include <csignal>

namespace reed::plant {
namespace {

volatile std::sig_atomic_t g_stop = 0;

void OnSignal(int /*signal*/) { g_stop = 1; }

}  // namespace

void InstallStopSignals() {
  struct sigaction action {};
  action.sa_handler = OnSignal;  // no SA_RESTART: a waiting system call returns and the loop sees the request
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
}

bool StopRequested() noexcept { return g_stop != 0; }

}  // namespace reed::plant
