// Many datagrams with one system call, for both transports. All memory is here; nothing is allocated later.
// RT: safe after construction.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reed::bus {

inline constexpr int kMaxBatch = 32;

struct Datagram {
  std::span<const std::uint8_t> bytes;  // valid until the next Receive
  sockaddr_in source{};                 // of AF_INET sockets
  bool truncated = false;               // it was longer than a slot
};

/// The kernel's 32-bit count of datagrams lost in a full queue (SO_RXQ_OVFL), followed past its wrap.
class OverflowCount {
 public:
  void See(std::uint32_t count) noexcept {
    total_ += count - last_;  // modulo 2^32
    last_ = count;
  }
  std::uint64_t total() const noexcept { return total_; }

 private:
  std::uint32_t last_ = 0;
  std::uint64_t total_ = 0;
};

class ReceiveBatch {
 public:
  static constexpr std::size_t kSlotBytes = 512;  // a 64-byte frame in msgpack is 231 bytes

  ReceiveBatch();
  ReceiveBatch(const ReceiveBatch&) = delete;  // the headers point into the object
  ReceiveBatch& operator=(const ReceiveBatch&) = delete;

  /// At most min(`limit`, kMaxBatch) datagrams, without waiting. Returns their number, 0 if none, or -errno.
  int Receive(int fd, int limit) noexcept;
  /// The same with one system call for all of them: waits for `limit` datagrams, on a socket with a receive
  /// timeout for as long as none comes within it.
  int ReceiveAll(int fd, int limit) noexcept;
  /// Waits likewise for one, and takes those that are there with it.
  int ReceiveSome(int fd, int limit) noexcept;
  Datagram operator[](int i) const noexcept;

  /// Datagrams that the kernel dropped because the receive queue was full (SO_RXQ_OVFL), since the socket was
  /// opened.
  std::uint64_t overflowed() const noexcept { return overflow_.total(); }

 private:
  struct alignas(8) Slot {
    std::array<std::uint8_t, kSlotBytes> bytes;
    std::array<std::uint8_t, CMSG_SPACE(sizeof(std::uint32_t))> control;
    sockaddr_in source;
    iovec vector;
  };
  int Receive(int fd, int limit, int flags) noexcept;
  void ReadOverflow(msghdr& header) noexcept;

  std::array<Slot, kMaxBatch> slots_{};
  std::array<mmsghdr, kMaxBatch> headers_{};
  OverflowCount overflow_;
};

class SendBatch {
 public:
  static constexpr std::size_t kSlotBytes = 256;

  SendBatch();
  SendBatch(const SendBatch&) = delete;
  SendBatch& operator=(const SendBatch&) = delete;

  /// Neighbours of equal size, and one that is shorter behind them, pass the kernel's network stack as one from
  /// here on and become datagrams again in the queues of their receivers (UDP_SEGMENT): the answer of five joints costs half as much and wakes
  /// who waits for it once. Where the kernel cannot, each goes alone. Set-up only.
  void PassEqualSizesTogether(int udp_socket) noexcept;

  std::span<std::uint8_t, kSlotBytes> slot(int i) noexcept { return slots_[static_cast<std::size_t>(i)]; }
  void set_size(int i, std::size_t bytes) noexcept { vectors_[static_cast<std::size_t>(i)].iov_len = bytes; }

  /// Sends slots 0 .. count-1 in order on a connected or bound socket, without waiting. Returns how many the
  /// kernel took, or -errno if it took none.
  int Send(int fd, int count) noexcept;

 private:
  struct alignas(cmsghdr) SegmentSize {
    std::array<std::uint8_t, CMSG_SPACE(sizeof(std::uint16_t))> bytes;
  };
  int Arrange(int count) noexcept;
  void SetSegmentSize(std::size_t message, std::size_t bytes) noexcept;

  bool together_ = false;
  std::array<std::array<std::uint8_t, kSlotBytes>, kMaxBatch> slots_{};
  std::array<iovec, kMaxBatch> vectors_{};
  std::array<mmsghdr, kMaxBatch> headers_{};
  std::array<SegmentSize, kMaxBatch> segment_sizes_{};
};

/// Waits until `fd` is readable (or has an error to report); false if CLOCK_MONOTONIC passed `deadline_ns`
/// first.
bool WaitReadable(int fd, std::int64_t deadline_ns) noexcept;

}  // namespace reed::bus
