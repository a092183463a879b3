// Every form of an LCM address: used with the group and port that it names, or not used with its own reason.
#include "reed/telemetry/lcm_url.h"

#include <gtest/gtest.h>

#include <tuple>

namespace reed::telemetry {
namespace {

TEST(LcmUrl, WhatItNamesIsRead) {
  const std::tuple<const char*, const char*, int> cases[] = {
      {"udpm://239.255.76.67:7667?ttl=0", "239.255.76.67", 7667},
      {"udpm://239.1.2.3:40000", "239.1.2.3", 40000},
      {"udpm://239.1.2.3:1?ttl=255&recv_buf_size=33554432", "239.1.2.3", 1},
      {"udpm://", "239.255.76.67", 7667},
      {"udpm://?ttl=1", "239.255.76.67", 7667},
  };
  for (const auto& [url, group, port] : cases) {
    LcmAddress address;
    EXPECT_EQ(ReadLcmUrl(url, address), "") << url;
    EXPECT_EQ(address.group, group) << url;
    EXPECT_EQ(address.port, port) << url;
  }
}

TEST(LcmUrl, EachMistakeHasItsOwnReason) {
  const std::pair<const char*, const char*> cases[] = {
      {"tcpq://localhost:7700", "tcpq can block"},
      {"file:///tmp/log?mode=w", "both programs would write the same file"},
      {"udp://239.255.76.67:7667", "its scheme is not udpm"},
      {"239.255.76.67:7667", "its scheme is not udpm"},
      {"udpm://239.255.76.67", "it has no port"},
      {"udpm://239.255.76.67?ttl=0", "it has no port"},
      {"udpm://239.255.76.67:", "\"\" is no port"},
      {"udpm://239.255.76.67:70000", "\"70000\" is no port"},
      {"udpm://239.255.76.67:0", "\"0\" is no port"},
      {"udpm://239.255.76.67:x", "\"x\" is no port"},
      {"udpm://10.0.0.1:7667", "\"10.0.0.1\" is no IPv4 multicast group"},
      {"udpm://239.255.76.67:7667?ttl=300", "\"ttl=300\" is no option"},
      {"udpm://239.255.76.67:7667?tll=0", "\"tll=0\" is no option"},
  };
  for (const auto& [url, reason] : cases) {
    LcmAddress address;
    const std::string problem = ReadLcmUrl(url, address);
    EXPECT_EQ(problem.rfind(reason, 0), 0U) << url << ": " << problem;
    EXPECT_EQ(problem.find("route"), std::string::npos) << "a route mends none of them: " << problem;
  }
}

}  // namespace
}  // namespace reed::telemetry
