#include "reed/rt/signals.h"

#include <csignal>

namespace reed::rt {
namespace {

std::atomic<bool> stop_wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "written by a signal handler");

}  // namespace

const std::atomic<bool>& StopFlag() {
  struct sigaction action {};  // no SA_RESTART: a system call that waits returns and the loop sees the wish
  action.sa_handler = [](int) { stop_wanted.store(true, std::memory_order_relaxed); };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);  // a terminal that is closed stops the arm in order, but for nohup
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  return stop_wanted;
}

}  // namespace reed::rt
