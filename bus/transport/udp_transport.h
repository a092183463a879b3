// The software bus: one CAN FD frame per UDP multicast datagram in the format of python-can's udp_multicast
// interface, on loopback only. python-can, cantools monitor and can_logger can join. Two sockets: frames sent
// here leave from a port of their own, by which the kernel keeps them from the receive socket. Frames from
// other machines are dropped. RT: safe after construction; the constructor throws std::runtime_error with one
// line and the fix.
#pragma once

#include <netinet/in.h>

#include <array>
#include <string>

#include "reed/bus/transport/datagram_transport.h"

namespace reed::bus {

struct UdpAddress {
  std::string group = "239.74.163.2";  // python-can's IPv4 group
  std::uint16_t port = 43113;
};

class UdpTransport final : public DatagramTransport {
 public:
  explicit UdpTransport(const UdpAddress& address, Identifiers identifiers = Identifiers::kOfTheDbc);
  std::string kind() const override { return "udp"; }
  std::string interface() const override { return address_.group + ":" + std::to_string(address_.port); }

 private:
  Incoming Read(const Datagram& datagram, Frame& out) noexcept override;
  std::size_t Write(const Frame& frame, std::span<std::uint8_t, SendBatch::kSlotBytes> out) noexcept override;
  bool IsFromThisMachine(const sockaddr_in& source) const noexcept;

  static constexpr std::size_t kMaxLocalAddresses = 32;

  UdpAddress address_;
  Identifiers identifiers_;
  FileDescriptor send_socket_;
  FileDescriptor receive_socket_;
  in_port_t own_port_ = 0;                                       // network order
  std::array<in_addr_t, kMaxLocalAddresses> local_addresses_{};  // network order, 0 where unused
};

}  // namespace reed::bus
