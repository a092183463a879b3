#include "reed/bus/transport/udp_transport.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/filter.h>
#include <net/if.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>

#include "reed/bus/transport/msgpack_frame.h"
#include "reed/bus/transport/socket_options.h"
#include "reed/rt/errno_text.h"
#include "reed_layout.h"

namespace reed::bus {
namespace {

[[noreturn]] void Fail(const UdpAddress& address, const std::string& what, const std::string& fix) {
  throw std::runtime_error("udp:" + address.group + ":" + std::to_string(address.port) + ": " + what +
                           "; fix: " + fix);
}

[[noreturn]] void FailNoRoute(const UdpAddress& address) {
  Fail(address, "no multicast on loopback (" + rt::ErrnoText() + ")",
       "sudo ip link set lo up multicast on; sudo ip route add 224.0.0.0/4 dev lo");
}

const sockaddr* Generic(const sockaddr_in& address) { return reinterpret_cast<const sockaddr*>(&address); }

sockaddr_in Parse(const UdpAddress& address) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(address.port);
  if (inet_pton(AF_INET, address.group.c_str(), &out.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(out.sin_addr.s_addr)) || address.port == 0) {
    Fail(address, "not a multicast address and port",
         "give GROUP:PORT with 224.0.0.0 <= GROUP <= 239.255.255.255");
  }
  return out;
}

FileDescriptor OpenSocket(const UdpAddress& address) {
  FileDescriptor fd(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (fd.get() < 0) Fail(address, "no UDP socket: " + rt::ErrnoText(), "enable IPv4");
  return fd;
}

ip_mreqn OnLoopback(in_addr group) {
  ip_mreqn request{};
  request.imr_multiaddr = group;
  request.imr_ifindex = static_cast<int>(if_nametoindex("lo"));
  return request;
}

/// What leaves by `own_port` never comes back to `fd`: the kernel drops it before it is queued, so that a
/// program is not woken by its own frames. A kernel without such filters queues it, and Read() drops it.
bool DropOwn(int fd, in_port_t own_port) {
  constexpr std::uint32_t kSourcePort = 0, kNothing = 0,
                          kEverything = 0xFFFFFFFF;  // offset in the UDP header
  std::array<sock_filter, 4> program{{{BPF_LD | BPF_H | BPF_ABS, 0, 0, kSourcePort},
                                      {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, ntohs(own_port)},
                                      {BPF_RET | BPF_K, 0, 0, kNothing},
                                      {BPF_RET | BPF_K, 0, 0, kEverything}}};
  const sock_fprog filter{program.size(), program.data()};
  return setsockopt(fd, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
}

bool IsOfTheDbc(std::uint32_t id) noexcept {
  return std::any_of(layout::kFrames.begin(), layout::kFrames.end(),
                     [id](const FrameLayout& frame) { return frame.id == id; });
}

}  // namespace

UdpTransport::UdpTransport(const UdpAddress& address, Identifiers identifiers)
    : address_(address),
      identifiers_(identifiers),
      send_socket_(OpenSocket(address)),
      receive_socket_(OpenSocket(address)) {
  const sockaddr_in group = Parse(address);
  const int out = send_socket_.get();
  SetOption(out, IPPROTO_IP, IP_MULTICAST_IF, OnLoopback(group.sin_addr), "multicast on loopback");
  SetOption(out, IPPROTO_IP, IP_MULTICAST_TTL, 0, "hop limit 0");
  SetOption(out, IPPROTO_IP, IP_MULTICAST_LOOP, 1, "multicast loop");
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (bind(out, Generic(own), sizeof own) < 0 || connect(out, Generic(group), sizeof group) < 0)
    FailNoRoute(address);
  socklen_t size = sizeof own;
  getsockname(out, reinterpret_cast<sockaddr*>(&own), &size);
  own_port_ = own.sin_port;

  const int in = receive_socket_.get();
  SetOption(in, SOL_SOCKET, SO_REUSEADDR, 1, "shared address");
  SetOption(in, SOL_SOCKET, SO_REUSEPORT, 1, "shared port");
  // Without this, a group that any socket has joined on any interface is heard: a frame of another machine, too.
  SetOption(in, IPPROTO_IP, IP_MULTICAST_ALL, 0, "the joined interface only");
  SetReceiveQueue(in);
  if (DropOwn(in, own_port_)) DropsOwn();
  if (bind(in, Generic(group), sizeof group) < 0) {
    Fail(address, "cannot bind: " + rt::ErrnoText(), "another program owns this port, choose another");
  }
  const ip_mreqn membership = OnLoopback(group.sin_addr);
  if (setsockopt(in, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) < 0) FailNoRoute(address);

  // What travels on the loopback may come from any of this machine's addresses.
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) == 0) {
    std::size_t count = 0;
    for (const ifaddrs* i = list; i != nullptr && count < kMaxLocalAddresses; i = i->ifa_next) {
      if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != AF_INET) continue;
      sockaddr_in local{};
      std::memcpy(&local, i->ifa_addr, sizeof local);
      local_addresses_[count++] = local.sin_addr.s_addr;
    }
    freeifaddrs(list);
  }
  Use(in, out);
  SendsUdp();
}

bool UdpTransport::IsFromThisMachine(const sockaddr_in& source) const noexcept {
  const in_addr_t address = source.sin_addr.s_addr;
  return (ntohl(address) >> IN_CLASSA_NSHIFT) == IN_LOOPBACKNET ||
         (address != 0 &&
          std::find(local_addresses_.begin(), local_addresses_.end(), address) != local_addresses_.end());
}

Incoming UdpTransport::Read(const Datagram& datagram, Frame& out) noexcept {
  if (!IsFromThisMachine(datagram.source) || datagram.source.sin_port == own_port_)
    return Incoming::kNotForUs;
  if (datagram.truncated) return Incoming::kMalformed;
  const Incoming found = UnpackFrame(datagram.bytes, out);
  const bool foreign = found == Incoming::kFrame && identifiers_ == Identifiers::kOfTheDbc &&
                       (out.extended || !IsOfTheDbc(out.id));
  return foreign ? Incoming::kForeignId : found;
}

std::size_t UdpTransport::Write(const Frame& frame,
                                std::span<std::uint8_t, SendBatch::kSlotBytes> out) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return PackFrame(frame, static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec), out);
}

}  // namespace reed::bus
