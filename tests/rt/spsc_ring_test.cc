#include "reed/rt/spsc_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <random>
#include <thread>

#include "reed/tests/support/no_alloc.h"

namespace reed::rt {
namespace {

/// Wide enough that a torn copy shows: every word is derived from the number.
struct Item {
  std::uint64_t number = 0;
  std::array<std::uint64_t, 31> echo{};

  static Item Of(std::uint64_t number) {
    Item item{number, {}};
    for (std::size_t i = 0; i < item.echo.size(); ++i) item.echo[i] = number * (2 * i + 3);
    return item;
  }
  bool Whole() const {
    for (std::size_t i = 0; i < echo.size(); ++i) {
      if (echo[i] != number * (2 * i + 3)) return false;
    }
    return true;
  }
};

TEST(SpscRing, HoldsAtLeastWhatWasAskedForAndThenRefuses) {
  SpscRing<int> ring(5);
  ASSERT_EQ(ring.capacity(), 8U);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(ring.Push(i));
  EXPECT_FALSE(ring.Push(8));
  EXPECT_EQ(ring.Claim(), nullptr);

  int item = -1;
  ASSERT_TRUE(ring.Pop(item));
  EXPECT_EQ(item, 0) << "a refused push must not overwrite the oldest item";
  EXPECT_TRUE(ring.Push(9));
  EXPECT_FALSE(ring.Push(10));
}

TEST(SpscRing, BehavesLikeAQueueOfThatLength) {
  std::mt19937 random(2);
  SpscRing<int> ring(4);
  std::deque<int> model;
  for (int i = 0; i < 100'000; ++i) {
    if (std::uniform_int_distribution<int>(0, 1)(random) == 0) {
      ASSERT_EQ(ring.Push(i), model.size() < 4);
      if (model.size() < 4) model.push_back(i);
    } else {
      int item = -1;
      ASSERT_EQ(ring.Pop(item), !model.empty());
      if (!model.empty()) {
        ASSERT_EQ(item, model.front());
        model.pop_front();
      }
    }
  }
}

TEST(SpscRing, AClaimedSlotIsInvisibleUntilItIsPublished) {
  SpscRing<int> ring(2);
  int* slot = ring.Claim();
  ASSERT_NE(slot, nullptr);
  *slot = 7;
  EXPECT_EQ(ring.Front(), nullptr);
  ring.Publish();
  ASSERT_NE(ring.Front(), nullptr);
  EXPECT_EQ(*ring.Front(), 7);
}

/// Two threads; every accepted item arrives once, whole and in order, and nothing else arrives.
TEST(SpscRing, TwoThreadsLoseNothingThatWasAcceptedAndTearNothing) {
  constexpr std::uint64_t kTries = 200'000;
  SpscRing<Item> ring(16);
  std::atomic<std::uint64_t> refused{0};
  std::atomic<bool> done{false};

  std::thread producer([&] {
    for (std::uint64_t accepted = 0; accepted < kTries;) {
      if (ring.Push(Item::Of(accepted + 1))) {
        ++accepted;
      } else {
        ++refused;
        std::this_thread::yield();
      }
    }
    done.store(true, std::memory_order_release);
  });

  while (refused == 0) std::this_thread::yield();  // start from a full ring
  std::uint64_t expected = 1, torn = 0, out_of_order = 0;
  while (true) {
    const bool last = done.load(std::memory_order_acquire);
    while (const Item* item = ring.Front()) {
      if (!item->Whole()) ++torn;
      if (item->number != expected) ++out_of_order;
      expected = item->number + 1;
      ring.PopFront();
    }
    if (last) break;
    std::this_thread::yield();
  }
  producer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(out_of_order, 0U);
  EXPECT_EQ(expected, kTries + 1);
}

TEST(SpscRing, AStalledConsumerCostsTheProducerOnlyTheItems) {
  SpscRing<Item> ring(64);
  const Item item = Item::Of(1);
  int accepted = 0;
  {
    const test::NoAlloc guard("pushing to a full ring");
    for (int i = 0; i < 10'000; ++i) accepted += ring.Push(item) ? 1 : 0;
  }
  EXPECT_EQ(accepted, 64);
}

}  // namespace
}  // namespace reed::rt
