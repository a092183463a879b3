// On a real CAN stack (vcan0, or the interface that REED_CAN_INTERFACE names). Fails where there is none.
#include "reed/bus/transport/socketcan_transport.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/tests/support/no_alloc.h"

namespace reed::bus {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t Now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

std::string Interface() {
  const char* name = std::getenv("REED_CAN_INTERFACE");
  return name != nullptr ? name : "vcan0";
}

/// A foreign node on the same interface, straight on the kernel's interface.
class RawNode {
 public:
  RawNode() : fd_(socket(PF_CAN, SOCK_RAW, CAN_RAW)) {
    const int on = 1;
    setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(Interface().c_str()));
    bound_ = bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawNode() { close(fd_); }
  bool bound() const { return bound_; }
  bool SendFd(canid_t id, std::uint8_t size, std::uint8_t first = 0) const {
    canfd_frame frame{};
    frame.can_id = id;
    frame.len = size;
    frame.data[0] = first;
    return write(fd_, &frame, CANFD_MTU) == static_cast<ssize_t>(CANFD_MTU);
  }
  bool SendClassic(canid_t id) const {
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = 8;
    return write(fd_, &frame, CAN_MTU) == static_cast<ssize_t>(CAN_MTU);
  }
  canfd_frame Read() const {
    canfd_frame frame{};
    EXPECT_EQ(read(fd_, &frame, sizeof frame), static_cast<ssize_t>(CANFD_MTU));
    return frame;
  }

 private:
  int fd_;
  bool bound_ = false;
};

class SocketCan : public testing::Test {
 protected:
  static std::vector<Frame> Take(SocketCanTransport& from, int wanted) {
    std::vector<Frame> out(256);
    out.resize(static_cast<std::size_t>(from.Receive(out, wanted, Now_ns() + 10 * kSecond_ns)));
    return out;
  }
  SocketCanTransport a_{Interface()};
  SocketCanTransport b_{Interface()};
  RawNode raw_;
};

TEST_F(SocketCan, FramesOfACycleArriveInOrderWithEveryByte) {
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
  EXPECT_EQ(b_.counters().frames_rx, 11U);
  EXPECT_EQ(a_.kind(), "socketcan");
  EXPECT_EQ(a_.interface(), Interface());
}

TEST_F(SocketCan, FramesGoOutAsCanFdWithBitRateSwitch) {
  ASSERT_TRUE(raw_.bound());
  FrameEncoder encoder;
  const std::array frame{encoder.Sync({1})};
  ASSERT_EQ(a_.Send(frame), 1);
  const canfd_frame got = raw_.Read();
  EXPECT_EQ(got.can_id, 0x080U);
  EXPECT_EQ(got.len, 8);
  EXPECT_NE(got.flags & CANFD_BRS, 0);
}

TEST_F(SocketCan, OwnFramesAreNotReceived) {
  FrameEncoder encoder;
  const std::array sync{encoder.Sync({1})}, command{encoder.Command({})};
  ASSERT_EQ(a_.Send(sync), 1);
  ASSERT_EQ(Take(b_, 1).size(), 1U);  // it did travel
  ASSERT_EQ(b_.Send(command), 1);
  const std::vector<Frame> got = Take(a_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].id, 0x200U);
}

TEST_F(SocketCan, ForeignIdentifiersAreFilteredByTheKernel) {
  ASSERT_TRUE(raw_.SendFd(0x123, 8) && raw_.SendFd(0x080 | CAN_EFF_FLAG, 8) && raw_.SendFd(0x109, 16));
  ASSERT_TRUE(raw_.SendFd(0x140, 32, 42));
  const std::vector<Frame> got = Take(a_, 1);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].id, 0x140U);
  EXPECT_EQ(got[0].size, 32);
  EXPECT_EQ(got[0].data[0], 42);
  EXPECT_EQ(a_.counters().malformed, 0U);
}

TEST_F(SocketCan, ClassicFrameUnderOurIdentifierIsMalformed) {
  ASSERT_TRUE(raw_.SendClassic(0x140) && raw_.SendFd(0x140, 32));
  EXPECT_EQ(Take(a_, 1).size(), 1U);
  EXPECT_EQ(a_.counters().malformed, 1U);
}

TEST_F(SocketCan, ErrorFramesAreCountedAndBusOffIsTheEnd) {
  ASSERT_TRUE(raw_.SendClassic(CAN_ERR_FLAG | CAN_ERR_CRTL) && raw_.SendFd(0x140, 32));
  EXPECT_EQ(Take(a_, 1).size(), 1U);
  EXPECT_EQ(a_.counters().error_frames, 1U);
  EXPECT_TRUE(a_.alive());
  ASSERT_TRUE(raw_.SendClassic(CAN_ERR_FLAG | CAN_ERR_BUSOFF));
  EXPECT_EQ(Take(a_, 1).size(), 0U) << "and it does not wait for a bus that is gone";
  EXPECT_EQ(a_.counters().error_frames, 2U);
  EXPECT_FALSE(a_.alive());
}

TEST_F(SocketCan, CycleTouchesNoHeap) {
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

TEST_F(SocketCan, WaitsForTheDeadlineWhenNothingComes) {
  const std::int64_t deadline = Now_ns() + kSecond_ns / 50;
  std::vector<Frame> out(8);
  EXPECT_EQ(a_.Receive(out, 1, deadline), 0);
  EXPECT_GE(Now_ns(), deadline);
}

TEST_F(SocketCan, FloodBeyondTheQueueIsCountedAsOverflow) {
  constexpr int kFlood = 40000;
  FrameEncoder encoder;
  std::uint64_t sent = 0;
  for (int n = 0; n < kFlood; n += 100) {
    std::vector<Frame> block;
    for (int i = 0; i < 100; ++i) block.push_back(encoder.Sync({}));
    sent += static_cast<std::uint64_t>(a_.Send(block));
  }
  std::vector<Frame> out(256);
  std::uint64_t received = 0;
  while (const int got = b_.Receive(out, 1, Now_ns() + kSecond_ns / 5))
    received += static_cast<std::uint64_t>(got);
  const std::array last{encoder.Sync({})};
  ASSERT_EQ(a_.Send(last), 1);  // the kernel reports the loss with the next frame that fits
  received += Take(b_, 1).size();
  EXPECT_GT(b_.counters().overflowed, 0U);
  EXPECT_EQ(received + b_.counters().overflowed, sent + 1);
}

/// Changes the interface for one test and puts it back.
class InterfaceControl {
 public:
  InterfaceControl() : fd_(socket(AF_INET, SOCK_DGRAM, 0)) {}
  ~InterfaceControl() {
    Up(false);
    Mtu(static_cast<int>(CANFD_MTU));
    Up(true);
    close(fd_);
  }
  bool Up(bool up) const {
    ifreq request = Named();
    if (ioctl(fd_, SIOCGIFFLAGS, &request) < 0) return false;
    const int flags = up ? request.ifr_flags | IFF_UP : request.ifr_flags & ~IFF_UP;
    request.ifr_flags = static_cast<short>(flags);
    return ioctl(fd_, SIOCSIFFLAGS, &request) == 0;
  }
  bool Mtu(int mtu) const {
    ifreq request = Named();
    request.ifr_mtu = mtu;
    return ioctl(fd_, SIOCSIFMTU, &request) == 0;
  }

 private:
  static ifreq Named() {
    ifreq request{};
    std::strncpy(request.ifr_name, Interface().c_str(), IFNAMSIZ - 1);
    return request;
  }
  int fd_;
};

std::string ErrorOf(const std::string& interface) {
  try {
    SocketCanTransport transport(interface);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(SocketCan, BusIsLostWhenTheInterfaceGoesDownWhileReceiving) {
  const InterfaceControl control;
  ASSERT_TRUE(control.Up(false)) << "needs CAP_NET_ADMIN";
  std::vector<Frame> out(8);
  EXPECT_EQ(a_.Receive(out, 1, Now_ns() + 10 * kSecond_ns), 0);
  EXPECT_FALSE(a_.alive());
  EXPECT_TRUE(b_.alive()) << "b has not looked yet";
}

TEST_F(SocketCan, BusIsLostWhenTheInterfaceGoesDownWhileSending) {
  const InterfaceControl control;
  ASSERT_TRUE(control.Up(false)) << "needs CAP_NET_ADMIN";
  FrameEncoder encoder;
  const std::array frames{encoder.Sync({1}), encoder.Command({})};
  EXPECT_EQ(a_.Send(frames), 0);
  EXPECT_FALSE(a_.alive());
  EXPECT_EQ(a_.counters().tx_refused, 2U);
}

TEST(SocketCanInterface, BusIsLostWhenTheInterfaceIsRemoved) {
  ASSERT_EQ(std::system("ip link add reed_gone0 type vcan && ip link set reed_gone0 mtu 72 up"), 0)
      << "needs CAP_NET_ADMIN";
  SocketCanTransport transport("reed_gone0");
  ASSERT_EQ(std::system("ip link del reed_gone0"), 0);
  std::vector<Frame> out(8);
  for (int look = 0; look < 3 && transport.alive(); ++look) {
    EXPECT_EQ(transport.Receive(out, 1, Now_ns() + 10 * kSecond_ns), 0);
  }
  EXPECT_FALSE(transport.alive());
}

TEST_F(SocketCan, OpeningADownInterfaceSaysHowToBringItUp) {
  const InterfaceControl control;
  ASSERT_TRUE(control.Up(false)) << "needs CAP_NET_ADMIN";
  EXPECT_EQ(ErrorOf(Interface()),
            "socketcan:" + Interface() + ": interface is down; fix: sudo ip link set " + Interface() + " up");
}

TEST_F(SocketCan, OpeningAClassicCanInterfaceSaysHowToSetItsMtu) {
  const InterfaceControl control;
  ASSERT_TRUE(control.Up(false) && control.Mtu(static_cast<int>(CAN_MTU)) && control.Up(true));
  EXPECT_NE(ErrorOf(Interface()).find("carries classic CAN only (MTU below 72); fix: "), std::string::npos);
}

TEST_F(SocketCan, OpeningWhatIsNoCanInterfaceIsRefused) {
  EXPECT_NE(ErrorOf("lo").find("socketcan:lo: not a CAN interface; fix: "), std::string::npos);
  EXPECT_NE(ErrorOf("reed_none0").find("socketcan:reed_none0: no such interface; fix: "), std::string::npos);
  EXPECT_NE(ErrorOf("").find("no such interface"), std::string::npos);
  EXPECT_NE(ErrorOf(std::string(40, 'x')).find("no such interface"), std::string::npos);
}

}  // namespace
}  // namespace reed::bus
