// Which LCM addresses are used. RT: set-up only.
#pragma once

#include <cstdint>
#include <string>

namespace reed::telemetry {

/// Never beyond this machine unless the user says so.
inline constexpr const char* kLcmLocalUrl = "udpm://239.255.76.67:7667?ttl=0";

struct LcmAddress {
  std::string group = "239.255.76.67";  // liblcm's, where the URL names none
  std::uint16_t port = 7667;
};

/// Reads udpm://[GROUP:PORT][?ttl=N&recv_buf_size=N]. Returns why the address is not used and what is allowed, empty when it is.
/// liblcm itself takes more: a server that may block its writers (tcpq), a file that both programs would replace, a port
/// that is missing and means 0.
std::string ReadLcmUrl(const std::string& url, LcmAddress& out);

}  // namespace reed::telemetry
