#include "reed/bus/transport/uring_receiver.h"

#include <linux/io_uring.h>
#include <linux/time_types.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "reed/rt/monotonic.h"

namespace reed::bus {
namespace {

constexpr unsigned kEntries = 8;  // of the submission ring: the one request, armed again now and then
constexpr std::uint16_t kGroup = 0;
// One wait: an interface that goes away completes a single request, which a wait for several does not see.
constexpr std::int64_t kLongestWait_ns = 20'000'000;

void* Map(int fd, std::size_t bytes, off_t offset) {
  const int flags = MAP_POPULATE | (fd < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED);
  void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, fd, offset);
  return at == MAP_FAILED ? nullptr : at;
}

unsigned* Word(void* ring, std::uint32_t offset) {
  return reinterpret_cast<unsigned*>(static_cast<std::uint8_t*>(ring) + offset);
}

}  // namespace

UringReceiver::~UringReceiver() {
  if (ring_fd_ >= 0) close(ring_fd_);
  if (rings_ != nullptr) munmap(rings_, rings_bytes_);
  if (entries_ != nullptr) munmap(entries_, entries_bytes_);
  if (buffer_ring_ != nullptr) munmap(buffer_ring_, buffer_ring_bytes_);
}

bool UringReceiver::Open(int fd) {
  io_uring_params parameters{};
  // Work is done when this thread enters the kernel and does not interrupt the compute phase. Not DEFER_TASKRUN:
  // it wakes after as many calls for work as completions are wanted, and one call here may stand for many
  // datagrams.
  parameters.flags =
      IORING_SETUP_SINGLE_ISSUER | IORING_SETUP_COOP_TASKRUN | IORING_SETUP_CQSIZE | IORING_SETUP_CLAMP;
  parameters.cq_entries = 4 * kBuffers;
  const long ring = syscall(__NR_io_uring_setup, kEntries, &parameters);
  if (ring < 0) return false;
  ring_fd_ = static_cast<int>(ring);
  if (!MapRings(&parameters) || !GiveBuffers()) {
    close(ring_fd_);
    ring_fd_ = -1;
    return false;
  }
  shape_.msg_namelen = sizeof(sockaddr_in);
  shape_.msg_controllen = CMSG_SPACE(sizeof(std::uint32_t));
  fd_ = fd;
  Arm(fd);
  return true;
}

bool UringReceiver::MapRings(const void* given) {
  const io_uring_params& p = *static_cast<const io_uring_params*>(given);
  rings_bytes_ = std::max<std::size_t>(p.sq_off.array + p.sq_entries * sizeof(unsigned),
                                       p.cq_off.cqes + p.cq_entries * sizeof(io_uring_cqe));
  entries_bytes_ = p.sq_entries * sizeof(io_uring_sqe);
  rings_ = Map(ring_fd_, rings_bytes_, IORING_OFF_SQ_RING);
  entries_ = Map(ring_fd_, entries_bytes_, IORING_OFF_SQES);
  if (rings_ == nullptr || entries_ == nullptr) return false;
  submit_tail_ = Word(rings_, p.sq_off.tail);
  submit_array_ = Word(rings_, p.sq_off.array);
  submit_mask_ = *Word(rings_, p.sq_off.ring_mask);
  complete_head_ = Word(rings_, p.cq_off.head);
  complete_tail_ = Word(rings_, p.cq_off.tail);
  complete_mask_ = *Word(rings_, p.cq_off.ring_mask);
  events_ = reinterpret_cast<io_uring_cqe*>(Word(rings_, p.cq_off.cqes));
  return true;
}

bool UringReceiver::GiveBuffers() {
  buffers_.assign(kBuffers * kBufferBytes, 0);
  buffer_ring_bytes_ = kBuffers * sizeof(io_uring_buf);
  buffer_ring_ = Map(-1, buffer_ring_bytes_, 0);
  if (buffer_ring_ == nullptr) return false;
  io_uring_buf_reg request{};
  request.ring_addr = reinterpret_cast<std::uintptr_t>(buffer_ring_);
  request.ring_entries = kBuffers;
  request.bgid = kGroup;
  if (syscall(__NR_io_uring_register, ring_fd_, IORING_REGISTER_PBUF_RING, &request, 1) < 0) return false;
  for (count_ = 0; count_ < kMaxBatch; ++count_)
    taken_[static_cast<std::size_t>(count_)] = static_cast<std::uint16_t>(count_);
  HandBack();
  for (count_ = 0; count_ < static_cast<int>(kBuffers) - kMaxBatch; ++count_)
    taken_[static_cast<std::size_t>(count_)] = static_cast<std::uint16_t>(kMaxBatch + count_);
  HandBack();
  return true;
}

/// The buffers of the last batch are the kernel's again.
void UringReceiver::HandBack() noexcept {
  auto* const list = static_cast<io_uring_buf*>(buffer_ring_);
  for (int i = 0; i < count_; ++i) {
    const std::uint16_t id = taken_[static_cast<std::size_t>(i)];
    io_uring_buf& entry = list[handed_++ & (kBuffers - 1)];
    entry.addr = reinterpret_cast<std::uintptr_t>(buffer(id));
    entry.len = kBufferBytes;
    entry.bid = id;
  }
  count_ = 0;
  // The tail lies in the first entry, where that has room for nothing else.
  std::atomic_ref(static_cast<io_uring_buf*>(buffer_ring_)->resv).store(handed_, std::memory_order_release);
}

void UringReceiver::Arm(int fd) noexcept {
  const unsigned tail = *submit_tail_;
  io_uring_sqe& entry = static_cast<io_uring_sqe*>(entries_)[tail & submit_mask_];
  std::memset(&entry, 0, sizeof entry);
  entry.opcode = IORING_OP_RECVMSG;
  entry.fd = fd;
  entry.addr = reinterpret_cast<std::uintptr_t>(&shape_);
  entry.len = 1;
  entry.ioprio = IORING_RECV_MULTISHOT;
  entry.flags = IOSQE_BUFFER_SELECT;
  entry.buf_group = kGroup;
  submit_array_[tail & submit_mask_] = tail & submit_mask_;
  std::atomic_ref(*submit_tail_).store(tail + 1, std::memory_order_release);
  to_submit_ = 1;
}

int UringReceiver::Wait(int wanted, int limit, std::int64_t deadline_ns) noexcept {
  HandBack();
  limit = std::min(limit, kMaxBatch);
  wanted = std::min(wanted, limit);
  Harvest(limit);
  for (bool in_time = true; in_time && error_ == 0 && (count_ < wanted || wanted == 0);) {
    const std::int64_t left_ns = deadline_ns - rt::NowNs();
    in_time = left_ns > 0 && wanted > 0;
    const int entered =
        Enter(in_time ? static_cast<unsigned>(wanted - count_) : 0, std::min(left_ns, kLongestWait_ns));
    if (entered < 0 && entered != -ETIME && entered != -EINTR) error_ = -entered;
    Harvest(limit);
  }
  const int error = error_;
  error_ = 0;
  return error != 0 && count_ == 0 ? -error : count_;
}

int UringReceiver::Enter(unsigned min_complete, std::int64_t left_ns) noexcept {
  __kernel_timespec timeout{left_ns / rt::kNsPerSecond, left_ns % rt::kNsPerSecond};
  io_uring_getevents_arg argument{};
  argument.ts = min_complete > 0 ? reinterpret_cast<std::uintptr_t>(&timeout) : 0;
  const long done = syscall(__NR_io_uring_enter, ring_fd_, to_submit_, min_complete,
                            IORING_ENTER_GETEVENTS | IORING_ENTER_EXT_ARG, &argument, sizeof argument);
  if (done < 0) return -errno;
  to_submit_ -= std::min(to_submit_, static_cast<unsigned>(done));
  return 0;
}

/// Datagrams that wait in the completion ring, without asking the kernel.
int UringReceiver::Harvest(int limit) noexcept {
  unsigned head = *complete_head_;
  const unsigned tail = std::atomic_ref(*complete_tail_).load(std::memory_order_acquire);
  for (; head != tail && count_ < limit; ++head) {
    if (!Take(events_[head & complete_mask_])) break;
  }
  std::atomic_ref(*complete_head_).store(head, std::memory_order_release);
  return count_;
}

/// False: an error that the caller must see first.
bool UringReceiver::Take(const io_uring_cqe& event) noexcept {
  if ((event.flags & IORING_CQE_F_MORE) == 0) Arm(fd_);  // out of buffers, or an error: armed anew
  if (event.res < 0) {
    if (event.res != -ENOBUFS) error_ = -event.res;
    return true;
  }
  if ((event.flags & IORING_CQE_F_BUFFER) == 0) return true;
  taken_[static_cast<std::size_t>(count_)] =
      static_cast<std::uint16_t>(event.flags >> IORING_CQE_BUFFER_SHIFT);
  const std::uint8_t* at = buffer(taken_[static_cast<std::size_t>(count_)]);
  io_uring_recvmsg_out head{};
  std::memcpy(&head, at, sizeof head);
  if (head.controllen >= CMSG_LEN(sizeof(std::uint32_t))) {
    cmsghdr control{};
    std::memcpy(&control, at + sizeof head + shape_.msg_namelen, sizeof control);
    std::uint32_t total = 0;
    std::memcpy(&total, at + sizeof head + shape_.msg_namelen + CMSG_LEN(0), sizeof total);
    if (control.cmsg_level == SOL_SOCKET && control.cmsg_type == SO_RXQ_OVFL) overflow_.See(total);
  }
  ++count_;
  return true;
}

Datagram UringReceiver::operator[](int i) const noexcept {
  const std::uint8_t* at = buffer(taken_[static_cast<std::size_t>(i)]);
  io_uring_recvmsg_out head{};
  std::memcpy(&head, at, sizeof head);
  Datagram datagram;
  std::memcpy(&datagram.source, at + sizeof head, sizeof datagram.source);
  constexpr std::size_t kPayload = sizeof head + sizeof(sockaddr_in) + CMSG_SPACE(sizeof(std::uint32_t));
  datagram.bytes = {at + kPayload, std::min<std::size_t>(head.payloadlen, kBufferBytes - kPayload)};
  datagram.truncated = (head.flags & MSG_TRUNC) != 0;
  return datagram;
}

}  // namespace reed::bus
