#include "reed/telemetry/lcm_publisher.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "reed/rt/errno_text.h"

namespace reed::telemetry {
namespace {

constexpr const char* kLocalUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* kNoRouteFix =
    "; fix: sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo";

std::string Resolve(const std::string& url) {
  if (!url.empty()) return url;
  const char* from_environment =
      std::getenv("LCM_DEFAULT_URL");  // NOLINT(concurrency-mt-unsafe): set-up only
  return from_environment != nullptr && *from_environment != '\0' ? from_environment : kLocalUrl;
}

/// Why datagrams to the group of a udpm URL could not leave, empty if they can. Asked before liblcm is, which
/// would print paragraphs of its own. Connecting a datagram socket looks up the route and sends nothing.
std::string RouteProblem(const std::string& url) {
  constexpr const char* kScheme = "udpm://";
  if (url.rfind(kScheme, 0) != 0) return {};
  std::string group = url.substr(std::strlen(kScheme));
  group = group.substr(0, group.find_first_of(":?"));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  if (inet_pton(AF_INET, group.empty() ? "239.255.76.67" : group.c_str(), &address.sin_addr) != 1) {
    return "\"" + group + "\" is no IPv4 multicast group; allowed: udpm://GROUP:PORT?ttl=N";
  }
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return rt::ErrnoText();
  std::string problem;
  if (connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    problem = std::string("no route to ") + group + ": " + rt::ErrnoText() + kNoRouteFix;
  }
  close(probe);
  return problem;
}

}  // namespace

LcmPublisher::LcmPublisher(const std::string& url, bool wanted) {
  if (!wanted) return;
  report_.name = Resolve(url);
  if (report_.name.rfind("tcpq://", 0) == 0) {
    // Its publish blocks while the server does not read, and the log would wait behind it.
    report_.problem = "LCM " + report_.name + " not used: tcpq can block; fix: LCM_DEFAULT_URL=" + kLocalUrl;
    return;
  }
  if (const std::string problem = RouteProblem(report_.name); !problem.empty()) {
    report_.problem = "LCM " + report_.name + " not used: " + problem;
    return;
  }
  lcm_.reset(lcm_create(report_.name.c_str()));
  if (!lcm_) report_.problem = "LCM " + report_.name + " not used: liblcm refused it" + kNoRouteFix;
}

void LcmPublisher::Publish(const char* channel, Bytes message) {
  if (!lcm_) return;
  if (lcm_publish(lcm_.get(), channel, message.data(), static_cast<unsigned>(message.size())) == 0) {
    ++report_.written;
    return;
  }
  ++report_.lost;
  if (report_.problem.empty()) {
    report_.problem = "LCM " + report_.name + ": " + rt::ErrnoText() + kNoRouteFix;
  }
}

}  // namespace reed::telemetry
