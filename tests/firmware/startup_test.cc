// What only a simulated arm may be asked for is refused where real drives may be.
#include <gtest/gtest.h>

#include <string>

#include "reed/firmware/startup/checks.h"
#include "reed/tests/support/fake_transport.h"

namespace reed {
namespace {

/// Why this check refuses this bus, "" if it does not.
template <typename Check>
std::string Refusal(Check check, const char* kind, const char* interface) {
  test::FakeTransport bus;
  bus.kind_name = kind;
  bus.interface_name = interface;
  try {
    check(bus);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(StartUp, LockstepAndHostPausesAreForSimulatedArmsOnly) {
  for (const auto check : {RefuseLockstepOnRealDrives, RefuseHostPauseOnRealDrives}) {
    EXPECT_EQ(Refusal(check, "udp", "239.74.163.2:43113"), "");
    EXPECT_EQ(Refusal(check, "socketcan", "vcan0"), "");
    const std::string refusal = Refusal(check, "socketcan", "can0");
    EXPECT_NE(refusal.find("socketcan:can0"), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  }
  EXPECT_NE(Refusal(RefuseHostPauseOnRealDrives, "socketcan", "can0").find("--host-pause"),
            std::string::npos);
}

}  // namespace
}  // namespace reed
