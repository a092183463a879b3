#include "reed/telemetry/lcm_url.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace reed::telemetry {
namespace {

constexpr std::string_view kScheme = "udpm://";

std::string Allowed() { return std::string("; allowed: udpm://GROUP:PORT?ttl=N, like ") + kLcmLocalUrl; }

std::string Quoted(std::string_view text) {
  std::string quoted(1, '"');
  quoted.append(text).push_back('"');
  return quoted;
}

bool ReadNumber(std::string_view text, long lowest, long highest, long& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size() && out >= lowest && out <= highest;
}

bool IsMulticast(const std::string& group) {
  in_addr address{};
  return inet_pton(AF_INET, group.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

/// "ttl=0&recv_buf_size=2000000"
std::string OptionProblem(std::string_view options) {
  while (!options.empty()) {
    const std::string_view option = options.substr(0, options.find('&'));
    options.remove_prefix(std::min(option.size() + 1, options.size()));
    const std::string_view key = option.substr(0, option.find('='));
    const std::string_view value = option.substr(std::min(key.size() + 1, option.size()));
    long number = 0;
    const bool known = (key == "ttl" && ReadNumber(value, 0, 255, number)) ||
                       (key == "recv_buf_size" && ReadNumber(value, 1, 1L << 30, number)) ||
                       (key == "transmit_only" && (value == "true" || value == "false"));
    if (!known) return Quoted(option) + " is no option of it" + Allowed();
  }
  return {};
}

}  // namespace

std::string ReadLcmUrl(const std::string& url, LcmAddress& out) {
  const std::string_view text = url;
  if (text.starts_with("tcpq://")) return std::string("tcpq can block; fix: LCM_DEFAULT_URL=") + kLcmLocalUrl;
  if (text.starts_with("file://"))
    return "both programs would write the same file; fix: --log, one for each program";
  if (!text.starts_with(kScheme)) return "its scheme is not udpm" + Allowed();
  const std::string_view rest = text.substr(kScheme.size());
  const std::string_view network = rest.substr(0, rest.find('?'));
  if (network.size() < rest.size()) {
    if (std::string problem = OptionProblem(rest.substr(network.size() + 1)); !problem.empty())
      return problem;
  }
  if (network.empty()) return {};
  const std::size_t colon = network.find(':');
  out.group = network.substr(0, colon);
  if (!IsMulticast(out.group)) return Quoted(out.group) + " is no IPv4 multicast group" + Allowed();
  long port = 0;
  if (colon == std::string_view::npos) return "it has no port" + Allowed();
  if (!ReadNumber(network.substr(colon + 1), 1, 65535, port))
    return Quoted(network.substr(colon + 1)) + " is no port (1 to 65535)" + Allowed();
  out.port = static_cast<std::uint16_t>(port);
  return {};
}

}  // namespace reed::telemetry
