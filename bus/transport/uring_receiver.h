// Datagrams of one socket through io_uring: a single system call waits until as many as are wanted have come,
// and ends at an exact time. Nothing else in Linux does both: ppoll wakes at the first datagram and does not
// read it, recvmmsg reads them all but rounds its timeout to the scheduler's tick. One request stays armed
// for the socket's life and fills buffers that are handed back once they were looked at. RT: safe after
// Open().
#pragma once

#include <cstdint>
#include <vector>

#include "reed/bus/transport/datagram_batch.h"

struct io_uring_cqe;

namespace reed::bus {

class UringReceiver {
 public:
  UringReceiver() = default;
  ~UringReceiver();
  UringReceiver(const UringReceiver&) = delete;
  UringReceiver& operator=(const UringReceiver&) = delete;

  /// Set-up only. False when the kernel is older than 6.0 or forbids io_uring, as containers often do: then
  /// nothing has changed. From here on only the calling thread may Wait(), and nobody else may read `fd`.
  bool Open(int fd);
  bool is_open() const noexcept { return ring_fd_ >= 0; }

  /// Returns once `wanted` (at most `limit`, that at most kMaxBatch) datagrams are there or CLOCK_MONOTONIC
  /// passes `deadline_ns`; a deadline in the past takes what has arrived. Returns their number, or -errno.
  int Wait(int wanted, int limit, std::int64_t deadline_ns) noexcept;
  /// Valid until the next Wait().
  Datagram operator[](int i) const noexcept;
  /// As ReceiveBatch's.
  std::uint64_t overflowed() const noexcept { return overflow_.total(); }

 private:
  static constexpr unsigned kBuffers = 64;  // a power of two, as the kernel wants it
  static constexpr std::size_t kBufferBytes =
      640;  // header, source, overflow count, ReceiveBatch::kSlotBytes

  bool MapRings(const void* parameters);
  bool GiveBuffers();
  void Arm(int fd) noexcept;
  int Enter(unsigned min_complete, std::int64_t left_ns) noexcept;
  int Harvest(int limit) noexcept;
  bool Take(const io_uring_cqe& event) noexcept;
  void HandBack() noexcept;
  const std::uint8_t* buffer(unsigned id) const noexcept { return buffers_.data() + id * kBufferBytes; }

  int ring_fd_ = -1, fd_ = -1;
  void* rings_ = nullptr;    // submission and completion ring, shared with the kernel
  void* entries_ = nullptr;  // submission entries
  void* buffer_ring_ = nullptr;
  std::size_t rings_bytes_ = 0, entries_bytes_ = 0, buffer_ring_bytes_ = 0;
  unsigned *submit_tail_ = nullptr, *submit_array_ = nullptr, *complete_head_ = nullptr,
           *complete_tail_ = nullptr;
  unsigned submit_mask_ = 0, complete_mask_ = 0;
  io_uring_cqe* events_ = nullptr;
  std::vector<std::uint8_t> buffers_;
  msghdr shape_{};  // how a buffer is divided
  unsigned to_submit_ = 0;
  std::uint16_t handed_ = 0;  // tail of the buffer ring
  std::array<std::uint16_t, kMaxBatch> taken_{};
  int count_ = 0;
  int error_ = 0;
  OverflowCount overflow_;
};

}  // namespace reed::bus
