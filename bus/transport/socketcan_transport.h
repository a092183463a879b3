// CAN FD on Linux SocketCAN (vcan0, can0): raw socket, kernel filters for the identifiers of the DBC, error
// frames counted, own frames not received. RT: safe after construction; the constructor throws
// std::runtime_error with one line that says what is wrong, with the fix.
#pragma once

#include <string>

#include "reed/bus/transport/datagram_transport.h"

namespace reed::bus {

class SocketCanTransport final : public DatagramTransport {
 public:
  explicit SocketCanTransport(const std::string& interface, Identifiers identifiers = Identifiers::kOfTheDbc);
  std::string kind() const override { return "socketcan"; }
  std::string interface() const override { return interface_; }

 private:
  Incoming Read(const Datagram& datagram, Frame& out) noexcept override;
  std::size_t Write(const Frame& frame, std::span<std::uint8_t, SendBatch::kSlotBytes> out) noexcept override;

  std::string interface_;
  FileDescriptor socket_;
};

}  // namespace reed::bus
