#include "reed/bus/transport/udp_transport.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/bus/transport/msgpack_frame.h"
#include "reed/tests/support/no_alloc.h"

namespace reed::bus {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t Now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

Frame NumberedFrame(int n) {
  Frame frame;
  frame.id = 0x101;
  frame.size = 16;
  frame.data[0] = static_cast<std::uint8_t>(n);
  frame.data[1] = static_cast<std::uint8_t>(n >> 8);
  return frame;
}
int NumberOf(const Frame& frame) { return frame.data[0] | frame.data[1] << 8; }

/// Two programs on a bus of their own: group and port differ between processes and tests.
class UdpBus : public testing::Test {
 protected:
  static UdpAddress NextAddress() {
    static int uses = 0;
    const int process = getpid();
    return {"239.74." + std::to_string(process % 200) + "." + std::to_string(1 + ++uses % 200),
            static_cast<std::uint16_t>(20000 + process % 20000)};
  }
  static std::vector<Frame> Take(UdpTransport& from, int wanted) {
    std::vector<Frame> out(256);
    out.resize(static_cast<std::size_t>(from.Receive(out, wanted, Now_ns() + 10 * kSecond_ns)));
    return out;
  }

  const UdpAddress address_ = NextAddress();
  UdpTransport a_{address_};
  UdpTransport b_{address_};
};

/// Any other program on this machine that can send to the group.
class Stranger {
 public:
  explicit Stranger(const UdpAddress& address) : fd_(socket(AF_INET, SOCK_DGRAM, 0)) {
    ip_mreqn loopback{};
    loopback.imr_ifindex = static_cast<int>(if_nametoindex("lo"));
    const int zero = 0;
    setsockopt(fd_, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
    setsockopt(fd_, IPPROTO_IP, IP_MULTICAST_TTL, &zero, sizeof zero);
    to_.sin_family = AF_INET;
    to_.sin_port = htons(address.port);
    inet_pton(AF_INET, address.group.c_str(), &to_.sin_addr);
  }
  ~Stranger() { close(fd_); }
  void Send(const std::vector<std::uint8_t>& bytes) const {
    ASSERT_EQ(sendto(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_),
              static_cast<ssize_t>(bytes.size()));
  }

 private:
  int fd_;
  sockaddr_in to_{};
};

TEST_F(UdpBus, FramesOfACycleArriveInOrderWithEveryByte) {
  FrameEncoder encoder;
  std::vector<Frame> sent{encoder.Sync({5})};
  for (int joint = 0; joint < kMaxJoints; ++joint) sent.push_back(encoder.JointState(joint, {0.1 * joint}));
  sent.push_back(encoder.Wrench({5, {1, 2, 3}, {4, 5, 6}, true}));
  sent.push_back(encoder.Command({5, DriveRequest::kEnable, {8, 7, 6, 5, 4, 3, 2, 1}}));
  ASSERT_EQ(a_.Send(sent), 11);
  const std::vector<Frame> got = Take(b_, 11);
  ASSERT_EQ(got.size(), 11U);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(got[i].id, sent[i].id);
    EXPECT_EQ(got[i].size, sent[i].size);
    EXPECT_EQ(got[i].data, sent[i].data);
  }
  EXPECT_EQ(a_.counters().frames_tx, 11U);
  EXPECT_EQ(b_.counters().frames_rx, 11U);
}

TEST_F(UdpBus, NeighboursOfEqualSizeStayDatagramsOfTheirOwnInOrder) {  // UDP_SEGMENT, across two batches
  std::vector<Frame> sent(2 * kMaxBatch - 1);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    sent[i] = NumberedFrame(static_cast<int>(i));
    sent[i].size = i % 11 < 7 ? 16 : i % 3 == 0 ? 64 : 8;
  }
  ASSERT_EQ(a_.Send(sent), static_cast<int>(sent.size()));
  const std::vector<Frame> got = Take(b_, static_cast<int>(sent.size()));
  ASSERT_EQ(got.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(NumberOf(got[i]), static_cast<int>(i));
    EXPECT_EQ(got[i].size, sent[i].size);
  }
  EXPECT_EQ(a_.counters().frames_tx, sent.size());
}

TEST_F(UdpBus, HeldFramesLeaveTogetherWithTheNextReceive) {
  a_.SendWithNextReceive();
  FrameEncoder encoder;
  const std::array<Frame, 1> command{encoder.Command({5, DriveRequest::kEnable, {8, 7, 6, 5, 4, 3, 2, 1}})};
  const std::array<Frame, 1> sync{encoder.Sync({6})};
  EXPECT_EQ(a_.Send(command), 1);
  EXPECT_EQ(a_.Send(sync), 1);
  EXPECT_EQ(a_.counters().frames_tx, 2U) << "as on any other bus";
  std::array<Frame, 8> out{};
  EXPECT_EQ(b_.Receive(out, 1, 0), 0);
  EXPECT_EQ(a_.Receive(out, 1, 0), 0);
  const std::vector<Frame> got = Take(b_, 1);
  ASSERT_EQ(got.size(), 2U) << "one call takes both";
  EXPECT_EQ(got[0].data, command[0].data);
  EXPECT_EQ(got[1].data, sync[0].data);
  EXPECT_EQ(a_.counters().frames_tx, 2U);

  std::vector<Frame> many;
  for (int n = 0; n < 11; ++n) many.push_back(NumberedFrame(n));
  for (const Frame& frame : many)
    EXPECT_EQ(a_.Send(std::span(&frame, 1)), 1) << "more than are held: in order";
  a_.SendHeld();
  EXPECT_EQ(Take(b_, 11).size(), 11U);
  EXPECT_EQ(a_.Send(many), 11) << "too many to be held";
  const std::vector<Frame> at_once = Take(b_, 11);
  ASSERT_EQ(at_once.size(), 11U);
  for (int n = 0; n < 11; ++n) EXPECT_EQ(NumberOf(at_once[static_cast<std::size_t>(n)]), n);
  EXPECT_EQ(a_.counters().frames_tx, 24U);
}

TEST_F(UdpBus, AnIdentifierThatIsNotInTheDbcIsCountedAndHandedToNobody) {
  Frame foreign = NumberedFrame(1);
  foreign.id = 0x7AB;
  ASSERT_EQ(a_.Send(std::array{foreign, NumberedFrame(2)}), 2);
  const std::vector<Frame> got = Take(b_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(NumberOf(got[0]), 2);
  EXPECT_EQ(b_.counters().foreign_ids, 1U);
  EXPECT_EQ(b_.counters().frames_rx, 1U);
}

TEST_F(UdpBus, AFloodOfForeignFramesEndsAReceiveLongBeforeItsDeadline) {
  Frame foreign = NumberedFrame(1);
  foreign.id = 0x7AB;
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a_.Send(std::array{foreign}), 1);
  std::vector<Frame> out(64);
  const std::int64_t start_ns = Now_ns();
  EXPECT_EQ(b_.Receive(out, 1, start_ns + 10 * kSecond_ns), 0);
  EXPECT_LT(Now_ns() - start_ns, 5 * kSecond_ns);
  EXPECT_GE(b_.counters().foreign_ids, 64U);
}

/// An interface that is up and has multicast, other than the loopback; 0: there is none.
int OtherInterface() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return 0;
  int found = 0;
  for (const ifaddrs* i = list; i != nullptr; i = i->ifa_next) {
    const bool can = (i->ifa_flags & IFF_UP) != 0 && (i->ifa_flags & IFF_MULTICAST) != 0 &&
                     (i->ifa_flags & IFF_LOOPBACK) == 0;
    if (can && i->ifa_addr != nullptr && i->ifa_addr->sa_family == AF_INET)
      found = static_cast<int>(if_nametoindex(i->ifa_name));
  }
  freeifaddrs(list);
  return found;
}

TEST_F(UdpBus, WhatComesByAnotherInterfaceIsNotHeard) {
  const int other = OtherInterface();
  if (other == 0) GTEST_SKIP() << "no interface with multicast beside the loopback";
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  ip_mreqn join{};
  inet_pton(AF_INET, address_.group.c_str(), &join.imr_multiaddr);
  join.imr_ifindex = other;
  const int zero = 0;
  ASSERT_EQ(setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &join, sizeof join), 0);
  ASSERT_EQ(setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &join, sizeof join), 0);
  ASSERT_EQ(setsockopt(fd, IPPROTO_IP, IP_MULTICAST_TTL, &zero, sizeof zero), 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(address_.port);
  to.sin_addr = join.imr_multiaddr;
  std::array<std::uint8_t, kMaxPackedFrame> bytes{};
  const std::size_t size = PackFrame(NumberedFrame(1), 0.0, bytes);
  ASSERT_EQ(sendto(fd, bytes.data(), size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to),
            static_cast<ssize_t>(size));
  close(fd);
  ASSERT_EQ(a_.Send(std::array{NumberedFrame(2)}), 1);
  const std::vector<Frame> got = Take(b_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(NumberOf(got[0]), 2);
}

TEST_F(UdpBus, OwnFramesAreNotReceived) {
  const std::array one{NumberedFrame(1)}, two{NumberedFrame(2)};
  ASSERT_EQ(a_.Send(one), 1);
  ASSERT_EQ(Take(b_, 1).size(), 1U);  // it did travel
  ASSERT_EQ(b_.Send(two), 1);
  const std::vector<Frame> got = Take(a_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(NumberOf(got[0]), 2);
  EXPECT_EQ(a_.counters().frames_rx, 1U);
}

TEST_F(UdpBus, OwnFramesAreNoLossAndCostNoWaiting) {
  for (int round = 0; round < 50; ++round) {
    const std::array mine{NumberedFrame(1), NumberedFrame(2)};
    const std::array theirs{NumberedFrame(3)};
    ASSERT_EQ(a_.Send(mine), 2);
    ASSERT_EQ(b_.Send(theirs), 1);
    std::vector<Frame> out(64);
    ASSERT_EQ(a_.Receive(out, 1, 0), 1) << "own frames in front of the others' are passed over at once";
  }
  EXPECT_EQ(a_.counters().frames_rx, 50U);
  EXPECT_EQ(a_.counters().overflowed, 0U);
  EXPECT_EQ(a_.counters().malformed, 0U);
}

TEST_F(UdpBus, DeadlineInThePastTakesAllThatHasArrived) {
  std::vector<Frame> sent;
  for (int n = 0; n < 100; ++n) sent.push_back(NumberedFrame(n));
  ASSERT_EQ(a_.Send(sent), 100);
  std::vector<Frame> out(256);
  ASSERT_EQ(b_.Receive(out, 1, 0), 100) << "loopback delivers within the sender's system call";
  for (int n = 0; n < 100; ++n) EXPECT_EQ(NumberOf(out[static_cast<std::size_t>(n)]), n);
  EXPECT_EQ(b_.Receive(out, 1, 0), 0);
}

TEST_F(UdpBus, ReceiveNeverWritesBeyondTheSpaceItWasGiven) {
  std::vector<Frame> sent;
  for (int n = 0; n < 10; ++n) sent.push_back(NumberedFrame(n));
  ASSERT_EQ(a_.Send(sent), 10);
  std::vector<Frame> out(4);
  ASSERT_EQ(b_.Receive(out, 99, Now_ns() + 10 * kSecond_ns), 4);
  EXPECT_EQ(NumberOf(out[3]), 3);
  ASSERT_EQ(b_.Receive(out, 4, 0), 4);
  EXPECT_EQ(NumberOf(out[0]), 4) << "the rest stays queued";
}

TEST_F(UdpBus, WaitsForTheDeadlineWhenLessThanWantedComes) {
  const std::array one{NumberedFrame(1)};
  ASSERT_EQ(a_.Send(one), 1);
  const std::int64_t deadline = Now_ns() + kSecond_ns / 50;
  std::vector<Frame> out(8);
  EXPECT_EQ(b_.Receive(out, 2, deadline), 1);
  EXPECT_GE(Now_ns(), deadline);
}

TEST_F(UdpBus, WhatIsNoFrameIsCountedAndDropped) {
  const Stranger stranger(address_);
  stranger.Send({});
  stranger.Send({0xC1});
  stranger.Send(std::vector<std::uint8_t>(300, 0x80));
  std::array<std::uint8_t, kMaxPackedFrame> packed{};
  const std::size_t size = PackFrame(NumberedFrame(77), 0.0, packed);
  std::vector<std::uint8_t> good(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size));
  std::vector<std::uint8_t> long_one = good;
  long_one.resize(2000);
  stranger.Send(long_one);
  stranger.Send(good);
  const std::vector<Frame> got = Take(b_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(NumberOf(got[0]), 77);
  EXPECT_EQ(b_.counters().malformed, 4U);
  EXPECT_EQ(b_.counters().frames_rx, 1U);
}

TEST_F(UdpBus, FloodBeyondTheQueueIsCountedAsOverflow) {
  constexpr int kFlood = 40000;
  for (int n = 0; n < kFlood; n += 100) {
    std::vector<Frame> block;
    for (int i = 0; i < 100; ++i) block.push_back(NumberedFrame(n + i));
    a_.Send(block);
  }
  std::vector<Frame> out(256);
  std::uint64_t received = 0;
  while (const int got = b_.Receive(out, 1, 0)) received += static_cast<std::uint64_t>(got);
  const std::array last{NumberedFrame(0)};
  a_.Send(last);  // the kernel reports the loss with the next frame that fits
  received += Take(b_, 1).size();
  EXPECT_GT(b_.counters().overflowed, 0U);
  EXPECT_EQ(received + b_.counters().overflowed, kFlood + 1U);
}

TEST_F(UdpBus, GroupIsJoinedOnLoopbackOnly) {
  in_addr group{};
  inet_pton(AF_INET, address_.group.c_str(), &group);
  char hex[9];
  std::snprintf(hex, sizeof hex, "%08X", group.s_addr);  // as the kernel prints it
  std::ifstream igmp("/proc/net/igmp");
  std::string line, device;
  std::vector<std::string> joined_on;
  while (std::getline(igmp, line)) {
    if (line[0] != '\t') device = line.substr(line.find('\t') + 1, line.find(' ') - line.find('\t') - 1);
    if (line.find(hex) != std::string::npos) joined_on.push_back(device);
  }
  EXPECT_EQ(joined_on, std::vector<std::string>{"lo"});
}

TEST_F(UdpBus, PacketsCannotLeaveThisMachine) {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  const int one = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
  setsockopt(fd, SOL_SOCKET, SO_REUSEPORT, &one, sizeof one);
  setsockopt(fd, IPPROTO_IP, IP_RECVTTL, &one, sizeof one);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(address_.port);
  inet_pton(AF_INET, address_.group.c_str(), &to.sin_addr);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  const std::array frame{NumberedFrame(1)};
  ASSERT_EQ(a_.Send(frame), 1);
  std::array<char, 512> bytes{};
  alignas(cmsghdr) std::array<char, 64> control{};
  sockaddr_in from{};
  iovec vector{bytes.data(), bytes.size()};
  msghdr header{&from, sizeof from, &vector, 1, control.data(), control.size(), 0};
  ASSERT_GT(recvmsg(fd, &header, 0), 0);
  const cmsghdr* option = CMSG_FIRSTHDR(&header);
  ASSERT_NE(option, nullptr);
  int hop_limit = -1;
  std::memcpy(&hop_limit, CMSG_DATA(option), sizeof hop_limit);
  EXPECT_EQ(hop_limit, 0);
  EXPECT_EQ(ntohl(from.sin_addr.s_addr), INADDR_LOOPBACK);
  close(fd);
}

TEST_F(UdpBus, CycleTouchesNoHeap) {
  FrameEncoder encoder;
  Decoder decoder;
  std::array<Frame, 8> out{}, in{};
  {
    const test::NoAlloc guard("one cycle of encode, send, receive, decode");
    out = {encoder.Sync({1}),         encoder.JointState(0, {}), encoder.JointState(1, {}),
           encoder.JointState(2, {}), encoder.JointState(3, {}), encoder.JointState(4, {}),
           encoder.Wrench({}),        encoder.Command({})};
    a_.Send(out);
    const int got = b_.Receive(in, 8, Now_ns() + 10 * kSecond_ns);
    for (int i = 0; i < got; ++i) decoder.Decode(in[static_cast<std::size_t>(i)]);
    b_.Receive(in, 1, Now_ns() + kSecond_ns / 1000);  // a wait that ends with the deadline
  }
  EXPECT_EQ(decoder.counters().accepted, 8U);
}

TEST_F(UdpBus, BusesOnOtherPortsAndGroupsAreNotHeard) {
  UdpTransport other_port({address_.group, static_cast<std::uint16_t>(address_.port + 1)});
  UdpTransport other_group({"239.73.1.1", address_.port});
  const std::array one{NumberedFrame(1)}, two{NumberedFrame(2)};
  ASSERT_EQ(other_port.Send(one), 1);
  ASSERT_EQ(other_group.Send(one), 1);
  ASSERT_EQ(a_.Send(two), 1);
  const std::vector<Frame> got = Take(b_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(NumberOf(got[0]), 2);
}

}  // namespace
}  // namespace reed::bus
