#include "reed/bus/transport/socketcan_transport.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "reed/bus/transport/socket_options.h"
#include "reed/rt/errno_text.h"
#include "reed_layout.h"

namespace reed::bus {
namespace {

[[noreturn]] void Fail(const std::string& interface, const std::string& what, const std::string& fix) {
  throw std::runtime_error("socketcan:" + interface + ": " + what + "; fix: " + fix);
}

ifreq Ask(int fd, const std::string& interface, unsigned long request) {
  ifreq answer{};
  std::memcpy(answer.ifr_name, interface.data(), interface.size());
  if (ioctl(fd, request, &answer) < 0) {
    Fail(interface, "cannot be queried: " + rt::ErrnoText(), "see ip -details link show " + interface);
  }
  return answer;
}

/// The checks go from the kernel to the interface to its state, so that the first complaint is the cause.
FileDescriptor OpenSocket(const std::string& interface) {
  FileDescriptor fd(socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (fd.get() < 0 && (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT)) {
    Fail(interface, "this kernel has no CAN", "sudo modprobe can_raw, or use the bus vm or udp");
  }
  if (fd.get() < 0) Fail(interface, "no CAN socket: " + rt::ErrnoText(), "see tools/reed doctor");
  return fd;
}

int CheckInterface(int fd, const std::string& interface) {
  const std::string make =
      "sudo ip link add " + interface + " type vcan && sudo ip link set " + interface + " mtu 72 up";
  const unsigned index =
      interface.empty() || interface.size() >= IFNAMSIZ ? 0 : if_nametoindex(interface.c_str());
  if (index == 0) Fail(interface, "no such interface", make);
  if (Ask(fd, interface, SIOCGIFHWADDR).ifr_hwaddr.sa_family != ARPHRD_CAN) {
    Fail(interface, "not a CAN interface", "name one, or make one: sudo ip link add vcan0 type vcan");
  }
  if (Ask(fd, interface, SIOCGIFMTU).ifr_mtu < static_cast<int>(CANFD_MTU)) {
    Fail(interface, "carries classic CAN only (MTU below 72)",
         "sudo ip link set " + interface + " down && sudo ip link set " + interface +
             " mtu 72 up (real hardware: type can bitrate 1000000 dbitrate 5000000 fd on)");
  }
  if ((Ask(fd, interface, SIOCGIFFLAGS).ifr_flags & IFF_UP) == 0) {
    Fail(interface, "interface is down", "sudo ip link set " + interface + " up");
  }
  return static_cast<int>(index);
}

/// One exact filter per identifier: the kernel looks them up in a table, so foreign traffic does not wake the
/// loop.
void SetFilters(int fd) {
  std::array<can_filter, layout::kFrames.size()> filters{};
  for (std::size_t i = 0; i < filters.size(); ++i) {
    filters[i] = {layout::kFrames[i].id, CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK};
  }
  SetOption(fd, SOL_CAN_RAW, CAN_RAW_FILTER, filters, "CAN filters");
}

}  // namespace

SocketCanTransport::SocketCanTransport(const std::string& interface, Identifiers identifiers)
    : interface_(interface), socket_(OpenSocket(interface)) {
  const int fd = socket_.get();
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = CheckInterface(fd, interface);
  SetOption(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 1, "CAN FD frames");
  SetOption(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, 0, "own frames off");
  SetOption(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, can_err_mask_t{CAN_ERR_MASK}, "CAN error frames");
  if (identifiers == Identifiers::kOfTheDbc) SetFilters(fd);
  SetReceiveQueue(fd);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0) {
    Fail(interface, "cannot be used: " + rt::ErrnoText(), "see ip -details link show " + interface);
  }
  Use(fd, fd);
}

Incoming SocketCanTransport::Read(const Datagram& datagram, Frame& out) noexcept {
  const std::size_t size = datagram.bytes.size();
  if (size != CANFD_MTU && size != CAN_MTU) return Incoming::kMalformed;
  canfd_frame in{};
  std::memcpy(&in, datagram.bytes.data(), size);
  if ((in.can_id & CAN_ERR_FLAG) != 0) {
    return (in.can_id & CAN_ERR_BUSOFF) != 0 ? Incoming::kBusOff : Incoming::kErrorFrame;
  }
  if (size != CANFD_MTU || (in.can_id & CAN_RTR_FLAG) != 0 || !IsCanFdSize(in.len)) {
    return Incoming::kMalformed;
  }
  out = Frame{};
  out.extended = (in.can_id & CAN_EFF_FLAG) != 0;
  out.id = in.can_id & (out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  out.size = in.len;
  std::memcpy(out.data.data(), in.data, in.len);
  return Incoming::kFrame;
}

std::size_t SocketCanTransport::Write(const Frame& frame,
                                      std::span<std::uint8_t, SendBatch::kSlotBytes> out) noexcept {
  canfd_frame frame_out{};
  frame_out.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U);
  frame_out.len = frame.size;
  frame_out.flags = CANFD_BRS;
  std::memcpy(frame_out.data, frame.data.data(), frame.data.size());
  std::memcpy(out.data(), &frame_out, sizeof frame_out);
  return sizeof frame_out;
}

}  // namespace reed::bus
