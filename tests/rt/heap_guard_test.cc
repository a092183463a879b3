#include "reed/rt/heap_guard.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace reed::rt {
namespace {

/// Keeps the optimiser from removing a malloc whose block nobody looks at.
void Use(void* block) { asm volatile("" : : "g"(block) : "memory"); }

class HeapCountTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HeapCount::Works())
      GTEST_SKIP() << "the sanitizer brings its own allocator; release builds run this test";
  }
  static std::int64_t CallsIn(const std::function<void()>& work) {
    const HeapCount count;
    work();
    return count.calls();
  }
};

TEST_F(HeapCountTest, CountsEveryMemberOfTheFamily) {
  void* block = nullptr;
  EXPECT_EQ(CallsIn([&] { Use(block = std::malloc(10)); }), 1);
  EXPECT_EQ(CallsIn([&] { Use(block = std::realloc(block, 1000)); }), 1);
  EXPECT_EQ(CallsIn([&] { std::free(block); }), 1);
  EXPECT_EQ(CallsIn([&] { Use(block = std::calloc(3, 7)); }), 1);
  std::free(block);
  EXPECT_EQ(CallsIn([&] { Use(block = std::aligned_alloc(64, 128)); }), 1);
  std::free(block);
  EXPECT_EQ(CallsIn([&] { EXPECT_EQ(posix_memalign(&block, 64, 100), 0); }), 1);
  std::free(block);
  EXPECT_EQ(CallsIn([&] { Use(block = memalign(32, 100)); }), 1);
  std::free(block);
}

TEST_F(HeapCountTest, CountsWhatTheLibrariesDoInOurName) {
  struct alignas(128) Wide {
    char bytes[128];
  };
  EXPECT_EQ(CallsIn([] { Use(std::make_unique<int>(1).get()); }), 2) << "new and delete";
  EXPECT_EQ(CallsIn([] { Use(std::make_unique<Wide>().get()); }), 2) << "aligned new and delete";
  EXPECT_EQ(CallsIn([] { Use(std::string(100, 'x').data()); }), 2);
  char* line = nullptr;
  EXPECT_EQ(CallsIn([&] { Use(line = strdup("called from inside libc")); }), 1);
  std::free(line);
}

TEST_F(HeapCountTest, TheBlocksAreRealOnes) {
  void* block = nullptr;
  ASSERT_EQ(posix_memalign(&block, 4096, 10), 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % 4096, 0U);
  std::free(block);
  EXPECT_EQ(posix_memalign(&block, 3, 10), EINVAL);
  auto* zeros = static_cast<unsigned char*>(std::calloc(1000, 1));
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(zeros[i], 0);
  std::free(zeros);
}

TEST_F(HeapCountTest, ArithmeticCountsNothing) {
  volatile double x = 1.0;
  EXPECT_EQ(CallsIn([&] { x = x * 2.0; }), 0);
}

TEST_F(HeapCountTest, WhatIsDoneForOthersInAPauseIsNotCounted) {
  const HeapCount count;
  {
    const HeapPause pause;
    {
      const HeapPause within;
      Use(std::make_unique<int>(1).get());
    }
    Use(std::make_unique<int>(2).get());
  }
  EXPECT_EQ(count.calls(), 0);
  Use(std::make_unique<int>(3).get());
  EXPECT_EQ(count.calls(), 2) << "and all after it is";
}

TEST_F(HeapCountTest, CountsOnlyTheThreadThatAskedAndOnlyWhileItAsks) {
  std::atomic<bool> stop{false};
  std::atomic<int> made{0};
  std::thread other([&] {
    while (!stop) {
      Use(std::make_unique<int>(3).get());
      ++made;
    }
  });
  std::int64_t calls = -1;
  {
    const HeapCount count;
    for (const int start = made; made < start + 1000;) std::this_thread::yield();
    calls = count.calls();
  }
  stop = true;
  other.join();
  EXPECT_EQ(calls, 0);
  Use(std::make_unique<int>(4).get());
  EXPECT_EQ(HeapCount().calls(), 0) << "calls from before the count";
}

}  // namespace
}  // namespace reed::rt
