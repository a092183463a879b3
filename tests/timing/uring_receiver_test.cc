// One system call that waits for so many datagrams and ends at an exact time. Skipped where the kernel
// forbids io_uring, as containers do: the transports then wait with ppoll.
#include "reed/bus/transport/uring_receiver.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <thread>

#include "reed/bus/transport/udp_transport.h"
#include "reed/rt/clock.h"

namespace reed::bus {
namespace {

constexpr std::int64_t kMs = 1'000'000;

std::int64_t Now() { return rt::MonotonicClock{}.NowNs(); }

class UringTest : public ::testing::Test {
 protected:
  void SetUp() override {
    in_ = socket(AF_INET, SOCK_DGRAM, 0);
    out_ = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(bind(in_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    socklen_t size = sizeof to;
    getsockname(in_, reinterpret_cast<sockaddr*>(&to), &size);
    ASSERT_EQ(connect(out_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    size = sizeof source_;
    getsockname(out_, reinterpret_cast<sockaddr*>(&source_), &size);
    if (!receiver_.Open(in_)) GTEST_SKIP() << "no io_uring here";
  }
  ~UringTest() override {
    close(in_);
    close(out_);
  }
  void Send(int first, int count) const {
    for (int i = first; i < first + count; ++i) ASSERT_EQ(send(out_, &i, sizeof i, 0), sizeof i);
  }
  int Number(int i) const {
    int number = -1;
    EXPECT_EQ(receiver_[i].bytes.size(), sizeof number);
    std::memcpy(&number, receiver_[i].bytes.data(), sizeof number);
    return number;
  }

  int in_ = -1, out_ = -1;
  sockaddr_in source_{};
  UringReceiver receiver_;
};

TEST_F(UringTest, TakesWhatIsThereInOrderWithItsSource) {
  Send(0, 6);
  ASSERT_EQ(receiver_.Wait(6, kMaxBatch, Now() + 1000 * kMs), 6);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(Number(i), i);
    EXPECT_EQ(receiver_[i].source.sin_port, source_.sin_port);
    EXPECT_FALSE(receiver_[i].truncated);
  }
}

TEST_F(UringTest, WaitsForAllThatAreWantedAndNotForMore) {
  std::thread sender([&] {
    for (int i = 0; i < 6; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      Send(i, 1);
    }
  });
  const std::int64_t deadline = Now() + 60'000 * kMs;
  EXPECT_EQ(receiver_.Wait(6, kMaxBatch, deadline), 6);
  EXPECT_LT(Now(), deadline) << "it slept on although everything was there";
  sender.join();
}

TEST_F(UringTest, EndsAtItsDeadlineWithWhatHasCome) {
  Send(0, 2);
  const std::int64_t deadline = Now() + 3 * kMs;
  EXPECT_EQ(receiver_.Wait(6, kMaxBatch, deadline), 2);
  EXPECT_GE(Now(), deadline);
  EXPECT_EQ(receiver_.Wait(6, kMaxBatch, Now() + kMs), 0);
}

TEST_F(UringTest, ADeadlineInThePastTakesWhatHasArrived) {
  EXPECT_EQ(receiver_.Wait(1, kMaxBatch, 0), 0);
  Send(0, 3);
  EXPECT_EQ(receiver_.Wait(1, kMaxBatch, 0), 3);
}

TEST_F(UringTest, ALimitLeavesTheRestForTheNextWait) {
  Send(0, 5);
  EXPECT_EQ(receiver_.Wait(1, 2, Now() + 1000 * kMs), 2);
  EXPECT_EQ(receiver_.Wait(1, kMaxBatch, Now() + 1000 * kMs), 3);
  EXPECT_EQ(Number(0), 2);
}

TEST_F(UringTest, MoreThanTheBuffersHoldIsLeftInTheQueueAndNothingIsLost) {
  constexpr int kMany = 250;
  Send(0, kMany);
  int next = 0;
  while (next < kMany) {
    const int got = receiver_.Wait(1, kMaxBatch, Now() + 1000 * kMs);
    ASSERT_GT(got, 0) << "after " << next;
    for (int i = 0; i < got; ++i) ASSERT_EQ(Number(i), next++);
  }
}

TEST_F(UringTest, RunsForEverThroughItsRings) {
  for (int k = 0; k < 70'000; ++k) {  // the buffer ring's tail has 16 bits
    Send(k, 1);
    ASSERT_EQ(receiver_.Wait(1, kMaxBatch, Now() + 1000 * kMs), 1);
    ASSERT_EQ(Number(0), k);
  }
}

TEST_F(UringTest, ADatagramThatIsTooLongIsCutAndSaysSo) {
  const std::array<char, 2000> longest{};
  ASSERT_EQ(send(out_, longest.data(), longest.size(), 0), static_cast<ssize_t>(longest.size()));
  ASSERT_EQ(receiver_.Wait(1, kMaxBatch, Now() + 1000 * kMs), 1);
  EXPECT_TRUE(receiver_[0].truncated);
  EXPECT_LE(receiver_[0].bytes.size(), ReceiveBatch::kSlotBytes + 128);
}

TEST(UdpByUring, SendsAndReceivesFramesAndNeverItsOwn) {
  const UdpAddress own{"239.74.163.2",
                       static_cast<std::uint16_t>(20000 + getpid() % 20000)};  // of this process alone
  UdpTransport a(own), b(own);
  if (!a.ReceiveOnThisThread()) GTEST_SKIP() << "no io_uring here";
  Frame frame{0x101, 16, {}};
  std::array<Frame, 8> got{};
  for (int k = 0; k < 1000; ++k) {
    frame.data[0] = static_cast<std::uint8_t>(k);
    a.Send(std::span(&frame, 1));
    b.Send(std::span(&frame, 1));
    ASSERT_EQ(a.Receive(got, 1, Now() + 1000 * kMs), 1);
    EXPECT_EQ(got[0].data[0], frame.data[0]);
  }
  EXPECT_EQ(a.Receive(got, 1, 0), 0);
  EXPECT_EQ(a.counters().frames_rx, 1000U);
  EXPECT_EQ(a.counters().overflowed, 0U);
}

}  // namespace
}  // namespace reed::bus
