#include "bus/datagram_transport.h"

#include <algorithm>
#include <cerrno>

namespace reed::bus {
namespace {

/// A flood of datagrams that are not for us may cost at most so many system calls per Receive.
constexpr int kMaxBatchesPerDrain = 16;

bool MeansBusLost(int error) noexcept {
  return error == ENETDOWN || error == ENODEV || error == ENXIO || error == ENETUNREACH || error == EBADF;
}

}  // namespace

void DatagramTransport::Use(int receive_fd, int send_fd) noexcept {
  receive_fd_ = receive_fd;
  send_fd_ = send_fd;
}

int DatagramTransport::Receive(std::span<Frame> out, int wanted, std::int64_t deadline_ns) noexcept {
  const int enough = std::min(wanted, static_cast<int>(out.size()));
  int count = Drain(out);  // first without waiting: late in a cycle everything is there already
  while (count < enough && alive_ && WaitReadable(receive_fd_, deadline_ns)) {
    count += Drain(out.subspan(static_cast<std::size_t>(count)));
  }
  return count;
}

bool DatagramTransport::Take(Incoming incoming) noexcept {
  switch (incoming) {
    case Incoming::kFrame:
      return true;
    case Incoming::kMalformed:
      ++counters_.malformed;
      break;
    case Incoming::kBusOff:
      alive_ = false;
      [[fallthrough]];
    case Incoming::kErrorFrame:
      ++counters_.error_frames;
      break;
    case Incoming::kNotForUs:
      break;
  }
  return false;
}

int DatagramTransport::Drain(std::span<Frame> out) noexcept {
  std::size_t count = 0;
  for (int batch = 0; batch < kMaxBatchesPerDrain && count < out.size(); ++batch) {
    const int limit = std::min(kMaxBatch, static_cast<int>(out.size() - count));
    const int got = received_.Receive(receive_fd_, limit);
    if (got < 0) NoteError(-got);
    for (int i = 0; i < got; ++i) {
      if (Take(Read(received_[i], out[count]))) ++count;
    }
    if (got < limit) break;  // the queue is empty
  }
  counters_.frames_rx += count;
  counters_.overflowed = received_.overflowed();
  return static_cast<int>(count);
}

int DatagramTransport::Send(std::span<const Frame> frames) noexcept {
  std::size_t taken = 0;
  while (taken < frames.size()) {
    const int count = static_cast<int>(std::min<std::size_t>(kMaxBatch, frames.size() - taken));
    for (int i = 0; i < count; ++i) {
      sending_.set_size(i, Write(frames[taken + static_cast<std::size_t>(i)], sending_.slot(i)));
    }
    const int sent = sending_.Send(send_fd_, count);
    if (sent < 0) NoteError(-sent);
    taken += static_cast<std::size_t>(std::max(sent, 0));
    if (sent < count)
      break;  // a frame that the kernel refused is late already: dropped, with those behind it
  }
  counters_.frames_tx += taken;
  counters_.tx_refused += frames.size() - taken;
  return static_cast<int>(taken);
}

void DatagramTransport::NoteError(int error) noexcept {
  if (MeansBusLost(error)) alive_ = false;
}

}  // namespace reed::bus
