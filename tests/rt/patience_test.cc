// Waiting for a thread that may never be done.
#include "reed/rt/patience.h"

#include <gtest/gtest.h>

namespace reed::rt {
namespace {

TEST(Patience, EndsWithTheWorkOrWhenNothingMovesAnyMore) {
  std::atomic<bool> done{true};
  std::atomic<std::int64_t> progress{0};
  EXPECT_TRUE(AwaitDone(done, progress, 1'000'000));
  done = false;
  EXPECT_FALSE(AwaitDone(done, progress, 1'000'000));
}

}  // namespace
}  // namespace reed::rt
