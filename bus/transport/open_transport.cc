#include "reed/bus/transport/open_transport.h"

#include <charconv>
#include <stdexcept>
#include <string>

#include "reed/bus/transport/socketcan_transport.h"
#include "reed/bus/transport/udp_transport.h"

namespace reed::bus {
namespace {

constexpr std::string_view kSocketCan = "socketcan:";
constexpr std::string_view kUdp = "udp:";

[[noreturn]] void FailName(std::string_view name) {
  throw std::runtime_error("bus \"" + std::string(name) +
                           "\" is unknown; allowed: socketcan:IFACE (socketcan:vcan0), udp, udp:GROUP:PORT "
                           "(udp:239.74.163.2:43113)");
}

UdpAddress ParseUdp(std::string_view name) {
  const std::string_view rest = name.substr(kUdp.size());
  const std::size_t colon = rest.find(':');
  if (colon == std::string_view::npos) FailName(name);
  const std::string_view digits = rest.substr(colon + 1);
  UdpAddress address{std::string(rest.substr(0, colon)), 0};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), address.port);
  if (error != std::errc{} || end != digits.data() + digits.size()) FailName(name);
  return address;
}

}  // namespace

std::unique_ptr<Transport> OpenTransport(std::string_view name, Identifiers identifiers) {
  if (name == "udp") return std::make_unique<UdpTransport>(UdpAddress{}, identifiers);
  if (name.starts_with(kUdp)) return std::make_unique<UdpTransport>(ParseUdp(name), identifiers);
  if (name.starts_with(kSocketCan))
    return std::make_unique<SocketCanTransport>(std::string(name.substr(kSocketCan.size())), identifiers);
  FailName(name);
}

bool ReceiveOnThisThread(Transport& transport) {
  auto* const datagrams = dynamic_cast<DatagramTransport*>(&transport);
  return datagrams != nullptr && datagrams->ReceiveOnThisThread();
}

void SendWithNextReceive(Transport& transport) {
  if (auto* const datagrams = dynamic_cast<DatagramTransport*>(&transport)) datagrams->SendWithNextReceive();
}

void SendHeld(Transport& transport) {
  if (auto* const datagrams = dynamic_cast<DatagramTransport*>(&transport)) datagrams->SendHeld();
}

}  // namespace reed::bus
