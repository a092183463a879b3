#include "reed/bus/transport/datagram_batch.h"

#include <netinet/udp.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "reed/rt/monotonic.h"

namespace reed::bus {

ReceiveBatch::ReceiveBatch() {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    slot.vector = {slot.bytes.data(), slot.bytes.size()};
    headers_[i].msg_hdr.msg_iov = &slot.vector;
    headers_[i].msg_hdr.msg_iovlen = 1;
    headers_[i].msg_hdr.msg_name = &slot.source;
    headers_[i].msg_hdr.msg_control = slot.control.data();
  }
}

int ReceiveBatch::Receive(int fd, int limit) noexcept { return Receive(fd, limit, MSG_DONTWAIT); }
int ReceiveBatch::ReceiveAll(int fd, int limit) noexcept { return Receive(fd, limit, 0); }
int ReceiveBatch::ReceiveSome(int fd, int limit) noexcept { return Receive(fd, limit, MSG_WAITFORONE); }

int ReceiveBatch::Receive(int fd, int limit, int flags) noexcept {
  const int count = std::min(limit, kMaxBatch);
  for (int i = 0; i < count; ++i) {
    msghdr& header = headers_[static_cast<std::size_t>(i)].msg_hdr;
    header.msg_namelen = sizeof(sockaddr_in);
    header.msg_controllen = sizeof(Slot::control);
  }
  int received = 0;
  do {
    received = recvmmsg(fd, headers_.data(), static_cast<unsigned>(count), flags, nullptr);
  } while (received < 0 && errno == EINTR);
  if (received < 0) return errno == EAGAIN ? 0 : -errno;
  for (int i = 0; i < received; ++i) ReadOverflow(headers_[static_cast<std::size_t>(i)].msg_hdr);
  return received;
}

Datagram ReceiveBatch::operator[](int i) const noexcept {
  const auto n = static_cast<std::size_t>(i);
  const Slot& slot = slots_[n];
  return {std::span(slot.bytes).first(std::min<std::size_t>(headers_[n].msg_len, kSlotBytes)), slot.source,
          (headers_[n].msg_hdr.msg_flags & MSG_TRUNC) != 0};
}

void ReceiveBatch::ReadOverflow(msghdr& header) noexcept {
  const cmsghdr* control = CMSG_FIRSTHDR(&header);
  if (control == nullptr || control->cmsg_level != SOL_SOCKET || control->cmsg_type != SO_RXQ_OVFL) return;
  std::uint32_t total = 0;
  std::memcpy(&total, CMSG_DATA(control), sizeof total);
  overflow_.See(total);
}

SendBatch::SendBatch() {
  for (std::size_t i = 0; i < slots_.size(); ++i) vectors_[i] = {slots_[i].data(), 0};
}

void SendBatch::PassEqualSizesTogether(int udp_socket) noexcept {
  constexpr int kNotByDefault = 0;  // each message says its own
  together_ = setsockopt(udp_socket, IPPROTO_UDP, UDP_SEGMENT, &kNotByDefault, sizeof kNotByDefault) == 0;
}

int SendBatch::Send(int fd, int count) noexcept {
  const int messages = Arrange(count);
  int sent = 0;
  do {
    sent = sendmmsg(fd, headers_.data(), static_cast<unsigned>(messages), MSG_DONTWAIT | MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  if (sent < 0) return -errno;
  std::size_t slots = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(sent); ++i) slots += headers_[i].msg_hdr.msg_iovlen;
  return static_cast<int>(slots);
}

/// Slots 0 .. count-1 as messages: one each, or one for neighbours that pass together. Returns their number.
int SendBatch::Arrange(int count) noexcept {
  std::size_t messages = 0;
  const auto end = static_cast<std::size_t>(count);
  for (std::size_t first = 0, next = 0; first < end; first = next) {
    next = first + 1;
    while (together_ && next < end && vectors_[next].iov_len == vectors_[first].iov_len) ++next;
    if (together_ && next < end && vectors_[next].iov_len < vectors_[first].iov_len)
      ++next;  // the last segment
    msghdr& header = headers_[messages].msg_hdr;
    header.msg_iov = &vectors_[first];
    header.msg_iovlen = next - first;
    SetSegmentSize(messages++, next - first > 1 ? vectors_[first].iov_len : 0);
  }
  return static_cast<int>(messages);
}

/// 0: the message is one datagram.
void SendBatch::SetSegmentSize(std::size_t message, std::size_t bytes) noexcept {
  msghdr& header = headers_[message].msg_hdr;
  header.msg_control = bytes > 0 ? segment_sizes_[message].bytes.data() : nullptr;
  header.msg_controllen = bytes > 0 ? sizeof(SegmentSize::bytes) : 0;
  if (bytes == 0) return;
  const auto size = static_cast<std::uint16_t>(bytes);
  cmsghdr* control = CMSG_FIRSTHDR(&header);
  control->cmsg_level = IPPROTO_UDP;
  control->cmsg_type = UDP_SEGMENT;
  control->cmsg_len = CMSG_LEN(sizeof size);
  std::memcpy(CMSG_DATA(control), &size, sizeof size);
}

bool WaitReadable(int fd, std::int64_t deadline_ns) noexcept {
  while (true) {
    const std::int64_t left_ns = deadline_ns - rt::NowNs();
    if (left_ns <= 0) return false;
    const timespec timeout{left_ns / rt::kNsPerSecond, left_ns % rt::kNsPerSecond};
    pollfd entry{fd, POLLIN, 0};
    const int ready = ppoll(&entry, 1, &timeout, nullptr);
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

}  // namespace reed::bus
