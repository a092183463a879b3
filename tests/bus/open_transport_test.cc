#include "reed/bus/transport/open_transport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>

namespace reed::bus {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string ErrorOf(const std::string& name) {
  try {
    OpenTransport(name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(OpenTransport, NamesThatMeanNothingSayWhatIsAllowed) {
  for (const char* name :
       {"", "can", "vcan0", "socketcan", "UDP", "udp:", "udp:239.74.163.2",
        "udp:239.74.163.2:", "udp:239.74.163.2:70000", "udp:239.74.163.2:-1", "udp:239.74.163.2:43113x"}) {
    const std::string error = ErrorOf(name);
    EXPECT_THAT(error,
                HasSubstr(std::string("\"").append(name).append("\" is unknown; allowed: socketcan:IFACE")));
    EXPECT_THAT(error, Not(HasSubstr("\n")));
  }
}

TEST(OpenTransport, AddressThatIsNoMulticastGroupIsRefused) {
  for (const char* name :
       {"udp:127.0.0.1:43113", "udp:240.0.0.1:43113", "udp:here:43113", "udp:239.74.163.2:0"}) {
    const std::string error = ErrorOf(name);
    EXPECT_THAT(error, HasSubstr(name));
    EXPECT_THAT(error, HasSubstr("224.0.0.0 <= GROUP <= 239.255.255.255"));
  }
}

TEST(OpenTransport, SocketCanNamesCauseAndFixWhereItCannotBe) {
  const int can = socket(PF_CAN, SOCK_RAW, 1);
  const bool kernel_has_can = can >= 0;
  if (kernel_has_can) close(can);
  const std::string error = ErrorOf("socketcan:reed_none0");
  EXPECT_THAT(error, HasSubstr("socketcan:reed_none0: "));
  EXPECT_THAT(error,
              HasSubstr(kernel_has_can ? "no such interface; fix: sudo ip link add reed_none0 type vcan"
                                       : "this kernel has no CAN; fix: sudo modprobe can_raw"));
}

TEST(OpenTransport, UdpSaysWhatItIs) {
  const auto transport = OpenTransport("udp:239.74.163.2:43114");
  EXPECT_EQ(transport->kind(), "udp");
  EXPECT_EQ(transport->interface(), "239.74.163.2:43114");
  EXPECT_TRUE(transport->alive());
}

}  // namespace
}  // namespace reed::bus
