#include "reed/telemetry/lcm_publisher.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>

#include "reed/rt/errno_text.h"
#include "reed/telemetry/lcm_url.h"

namespace reed::telemetry {
namespace {

constexpr const char* kNoRouteFix =
    "; fix: sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo";

std::string Resolve(const std::string& url) {
  if (!url.empty()) return url;
  const char* from_environment =
      std::getenv("LCM_DEFAULT_URL");  // NOLINT(concurrency-mt-unsafe): set-up only
  return from_environment != nullptr && *from_environment != '\0' ? from_environment : kLcmLocalUrl;
}

/// Why datagrams to this group could not leave, empty if they can. Asked before liblcm is, which would print
/// paragraphs of its own. Connecting a datagram socket looks up the route and sends nothing.
std::string RouteProblem(const LcmAddress& to) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  inet_pton(AF_INET, to.group.c_str(), &address.sin_addr);
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return rt::ErrnoText();
  std::string problem;
  if (connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    problem = std::string("no route to ") + to.group + ": " + rt::ErrnoText() + kNoRouteFix;
  }
  close(probe);
  return problem;
}

std::string Problem(const std::string& url) {
  LcmAddress address;
  const std::string problem = ReadLcmUrl(url, address);
  return problem.empty() ? RouteProblem(address) : problem;
}

}  // namespace

LcmPublisher::LcmPublisher(const std::string& url, bool wanted) {
  if (!wanted) return;
  report_.name = Resolve(url);
  if (const std::string problem = Problem(report_.name); !problem.empty()) {
    report_.problem = "LCM " + report_.name + " not used: " + problem;
    return;
  }
  lcm_.reset(lcm_create(report_.name.c_str()));
  if (!lcm_) report_.problem = "LCM " + report_.name + " not used: liblcm refused it";
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
