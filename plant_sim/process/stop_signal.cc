#include "reed/plant/process/stop_signal.h"

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
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup means that it goes on
}

bool StopRequested() noexcept { return g_stop != 0; }

}  // namespace reed::plant
