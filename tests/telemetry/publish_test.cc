// LCM over the network, on this machine only (ttl 0) and on ports of this test's own.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <set>
#include <string>

#include "reed/firmware/record/recorder.h"
#include "reed/rt/clock.h"
#include "reed/tests/telemetry/sample_snapshot.h"

namespace reed::telemetry {
namespace {

using test::SampleEventText;
using test::SampleSnapshot;

int TestPort() { return 20'000 + getpid() % 20'000; }
std::string TestUrl() { return "udpm://239.255.76.67:" + std::to_string(TestPort()) + "?ttl=0"; }

RecorderOptions PublishTo(const std::string& url) { return {"", "", "vcan0", true, url}; }

TEST(Publish, ASubscriberGetsTheNumbersOfTheSnapshot) {
  lcm_t* subscriber = lcm_create(TestUrl().c_str());
  ASSERT_NE(subscriber, nullptr) << "no multicast here; sudo ip link set lo multicast on && "
                                    "sudo ip route add 224.0.0.0/4 dev lo";
  std::set<std::int64_t> cycles;
  const auto on_control = [](const lcm_recv_buf_t* buffer, const char*, void* user) {
    reed::control_t control;
    ASSERT_GT(control.decode(buffer->data, 0, static_cast<int>(buffer->data_size)), 0);
    EXPECT_EQ(control.tau_law[2], test::Value(14, 2, control.cycle));
    static_cast<std::set<std::int64_t>*>(user)->insert(control.cycle);
  };
  lcm_subscribe(subscriber, "REED_CONTROL", on_control, &cycles);

  SnapshotRing ring(64);
  for (int cycle = 0; cycle < 10; ++cycle) ring.Push(SampleSnapshot(cycle, 5, 6));
  Recorder recorder(PublishTo(TestUrl()), TimeBase::Lockstep(1000.0), ring, SampleEventText);
  EXPECT_EQ(recorder.publish_problem(), "");
  recorder.Start();
  const RecorderReport report = recorder.Close();
  EXPECT_EQ(report.lcm.written, 4 * 10 + 1 + 2 + 5)
      << "four channels, one event, bus at cycles 0 and 9, five histograms";
  EXPECT_EQ(report.lcm.lost, 0);

  while (cycles.size() < 10 && lcm_handle_timeout(subscriber, 5000) > 0) {
  }
  EXPECT_EQ(cycles.size(), 10U);
  lcm_destroy(subscriber);
}

TEST(Publish, ASubscriberThatStoppedReadingChangesNothing) {
  const int deaf = socket(AF_INET, SOCK_DGRAM, 0);
  const int yes = 1, small = 2048;
  setsockopt(deaf, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  setsockopt(deaf, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_port = htons(static_cast<std::uint16_t>(TestPort()));
  ASSERT_EQ(bind(deaf, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
  ip_mreq group{};
  inet_pton(AF_INET, "239.255.76.67", &group.imr_multiaddr);
  ASSERT_EQ(setsockopt(deaf, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group), 0);

  constexpr int kCycles = 2000;
  SnapshotRing ring(2048);
  Recorder recorder(PublishTo(TestUrl()), TimeBase::Lockstep(1000.0), ring, SampleEventText);
  const std::int64_t start_ns = rt::MonotonicClock().NowNs();
  recorder.Start();
  int refused = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) refused += ring.Push(SampleSnapshot(cycle, 5, 6)) ? 0 : 1;
  const RecorderReport report = recorder.Close();
  EXPECT_EQ(refused, 0);
  EXPECT_EQ(report.snapshots, kCycles);
  EXPECT_EQ(report.lcm.lost, 0);
  const double elapsed_s = static_cast<double>(rt::MonotonicClock().NowNs() - start_ns) * 1e-9;
  EXPECT_LE(kCycles - report.thinned, 50 + 1000 * elapsed_s) << "more than a watcher can take";
  EXPECT_GE(report.lcm.written, 4 * (kCycles - report.thinned));
  close(deaf);
}

TEST(Publish, AnAddressThatIsNotUsedIsSaidOnceAndTheRingIsDrainedOn) {
  SnapshotRing ring(64);
  for (int cycle = 0; cycle < 20; ++cycle) ring.Push(SampleSnapshot(cycle, 5, 6));
  Recorder recorder(PublishTo("udpm://255.255.255.255:7667?ttl=0"), TimeBase::Lockstep(1000.0), ring,
                    SampleEventText);
  EXPECT_EQ(recorder.publish_problem(),
            "LCM udpm://255.255.255.255:7667?ttl=0 not used: \"255.255.255.255\" is no IPv4 multicast group; "
            "allowed: udpm://GROUP:PORT?ttl=N, like udpm://239.255.76.67:7667?ttl=0");
  recorder.Start();
  const RecorderReport report = recorder.Close();
  EXPECT_EQ(report.snapshots, 20);
  EXPECT_TRUE(report.Problems().empty()) << "it was said at start";
}

constexpr int kNamespacesForbidden = 77;

int PublishFromAnEmptyNetwork() {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return kNamespacesForbidden;
  SnapshotRing ring(2);
  const Recorder recorder(PublishTo("udpm://239.255.76.67:7667?ttl=0"), TimeBase::Lockstep(1000.0), ring,
                          SampleEventText);
  const std::string expected =
      "LCM udpm://239.255.76.67:7667?ttl=0 not used: no route to 239.255.76.67: Network is unreachable; "
      "fix: ";
  return recorder.publish_problem().rfind(expected, 0) == 0 ? 0 : 1;
}

TEST(Publish, TheMissingMulticastRouteOfAnEmptyNetworkIsNamed) {
  const auto named_or_impossible = [](int status) {
    return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kNamespacesForbidden);
  };
  EXPECT_EXIT(_exit(PublishFromAnEmptyNetwork()), named_or_impossible, "");
}

TEST(Publish, AProviderThatCanBlockIsNotUsed) {
  SnapshotRing ring(2);
  const Recorder recorder(PublishTo("tcpq://localhost:7700"), TimeBase::Lockstep(1000.0), ring,
                          SampleEventText);
  EXPECT_EQ(recorder.publish_problem().rfind("LCM tcpq://localhost:7700 not used: tcpq can block; fix: ", 0),
            0U)
      << recorder.publish_problem();
}

TEST(Publish, AGroupThatIsNoAddressIsNamed) {
  SnapshotRing ring(2);
  const Recorder recorder(PublishTo("udpm://somewhere:7667"), TimeBase::Lockstep(1000.0), ring,
                          SampleEventText);
  EXPECT_NE(recorder.publish_problem().find("\"somewhere\" is no IPv4 multicast group"), std::string::npos)
      << recorder.publish_problem();
}

TEST(Publish, TheEnvironmentsUrlIsHonouredAndSwitchedOffMeansSilent) {
  setenv("LCM_DEFAULT_URL", "tcpq://from.environment:1", 1);
  SnapshotRing ring(2);
  const Recorder asked(PublishTo(""), TimeBase::Lockstep(1000.0), ring, SampleEventText);
  EXPECT_NE(asked.publish_problem().find("tcpq://from.environment:1"), std::string::npos);
  RecorderOptions off;
  off.publish = false;
  const Recorder silent(off, TimeBase::Lockstep(1000.0), ring, SampleEventText);
  EXPECT_EQ(silent.publish_problem(), "");
  unsetenv("LCM_DEFAULT_URL");
}

}  // namespace
}  // namespace reed::telemetry
