#include "reed/rt/clock.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>

#include <atomic>
#include <thread>

namespace reed::rt {
namespace {

TEST(MonotonicClock, NeverWakesBeforeTheDeadline) {
  const MonotonicClock clock;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t deadline = clock.NowNs() + 200'000;
    clock.SleepUntil(deadline);
    EXPECT_GE(clock.NowNs(), deadline);
  }
}

TEST(ShortNs, WhatDoesNotFitReadsAsTheLongestThatDoes) {
  EXPECT_EQ(ShortNs(1'234), 1'234);
  EXPECT_EQ(ShortNs(-5), -5);
  EXPECT_EQ(ShortNs(3'000'000'000), 2'147'483'647);
  EXPECT_EQ(ShortNs(-3'000'000'000), -2'147'483'648);
}

TEST(MonotonicClock, ASignalDoesNotEndTheSleep) {
  struct sigaction action {};
  action.sa_handler = [](int) {};  // without SA_RESTART: system calls come back with EINTR
  struct sigaction old {};
  sigaction(SIGUSR1, &action, &old);

  std::atomic<bool> awake{false};
  std::atomic<bool> early{false};
  std::thread sleeper([&] {
    const MonotonicClock clock;
    const std::int64_t deadline = clock.NowNs() + 30'000'000;
    clock.SleepUntil(deadline);
    early = clock.NowNs() < deadline;
    awake = true;
  });
  while (!awake) {
    pthread_kill(sleeper.native_handle(), SIGUSR1);
    std::this_thread::yield();
  }
  sleeper.join();
  EXPECT_FALSE(early);
  sigaction(SIGUSR1, &old, nullptr);
}

TEST(MonotonicClock, ADeadlineInThePastReturnsAtOnce) {
  MonotonicClock().SleepUntil(1);  // a sleep until the next wrap would time the test out
}

}  // namespace
}  // namespace reed::rt
