#include "reed/bus/transport/datagram_transport.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "reed/rt/monotonic.h"

namespace reed::bus {
namespace {

/// A flood of datagrams that are not for us may cost at most so many system calls per Receive.
constexpr int kMaxBatchesPerDrain = 16;
/// And so many of them may pass before a Receive that waits returns without a frame.
constexpr std::uint64_t kMostPassedOver = 64;

/// With this much time left a blocking receive, whose timeout the kernel rounds to its own tick, is exact
/// enough.
constexpr std::int64_t kPatient_ns = 50'000'000;
constexpr timeval kReceiveTimeout{0, 10'000};

bool MeansBusLost(int error) noexcept {
  return error == ENETDOWN || error == ENODEV || error == ENXIO || error == ENETUNREACH || error == EBADF;
}

}  // namespace

void DatagramTransport::Use(int receive_fd, int send_fd) noexcept {
  receive_fd_ = receive_fd;
  send_fd_ = send_fd;
  setsockopt(receive_fd, SOL_SOCKET, SO_RCVTIMEO, &kReceiveTimeout, sizeof kReceiveTimeout);
}

int DatagramTransport::Receive(std::span<Frame> out, int wanted, std::int64_t deadline_ns) noexcept {
  SendHeld();
  const int enough = std::min(wanted, static_cast<int>(out.size()));
  if (uring_.is_open()) return ReceiveByUring(out, enough, deadline_ns);
  const std::uint64_t enough_of_others = PassedOver(counters_) + kMostPassedOver;
  int count = 0;
  while (count < enough && alive_ && PassedOver(counters_) < enough_of_others &&
         deadline_ns - rt::NowNs() > kPatient_ns) {
    count += Await(out.subspan(static_cast<std::size_t>(count)), enough - count);
  }
  if (!alive_ || (count == enough && enough > 0)) return count;
  bool waiting = false;
  do {
    waiting =
        count < enough && PassedOver(counters_) < enough_of_others && WaitReadable(receive_fd_, deadline_ns);
    count += Drain(out.subspan(static_cast<std::size_t>(count)));  // in vain or in time: takes what is there
  } while (waiting && alive_ && count < enough);
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
    case Incoming::kForeignId:
      ++counters_.foreign_ids;
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
    count += static_cast<std::size_t>(Read(received_, got, out.subspan(count)));
    if (got < limit) break;  // the queue is empty
  }
  return static_cast<int>(count);
}

/// One system call for all the frames that are waited for, when there is time: no look before, no poll.
int DatagramTransport::Await(std::span<Frame> out, int wanted) noexcept {
  const int room = std::min(kMaxBatch, static_cast<int>(out.size()));
  if (wanted == 1) return Read(received_, received_.ReceiveSome(receive_fd_, room), out);
  return Read(received_, received_.ReceiveAll(receive_fd_, std::min(wanted, room)), out);
}

/// Datagrams that are no frames for us do not count, so it may take another turn.
int DatagramTransport::ReceiveByUring(std::span<Frame> out, int enough, std::int64_t deadline_ns) noexcept {
  int count = 0;
  bool more = true;
  while (more && alive_) {
    const int room = static_cast<int>(out.size()) - count;
    const int got = uring_.Wait(enough - count, room, deadline_ns);
    count += Read(uring_, got, out.subspan(static_cast<std::size_t>(count)));
    more = count < enough && got > 0 && rt::NowNs() < deadline_ns;
  }
  return count;
}

template <typename Batch>
int DatagramTransport::Read(const Batch& batch, int got, std::span<Frame> out) noexcept {
  if (got < 0) NoteError(-got);
  std::size_t count = 0;
  for (int i = 0; i < got; ++i) {
    if (Take(Read(batch[i], out[count]))) ++count;
  }
  counters_.frames_rx += count;
  const std::uint64_t lost = batch.overflowed();
  counters_.overflowed = std::max(counters_.overflowed, lost - std::min(lost, own_dropped_));
  return static_cast<int>(count);
}

int DatagramTransport::Send(std::span<const Frame> frames) noexcept {
  if (!holds_ || frames.size() > held_.size()) {
    SendHeld();
    return Pass(frames);
  }
  if (held_count_ + frames.size() > held_.size()) SendHeld();
  std::copy(frames.begin(), frames.end(), held_.begin() + static_cast<std::ptrdiff_t>(held_count_));
  held_count_ += frames.size();
  counters_.frames_tx += frames.size();  // as if they had left; what the kernel refuses is taken back
  return static_cast<int>(frames.size());
}

void DatagramTransport::SendHeld() noexcept {
  if (held_count_ == 0) return;
  counters_.frames_tx -= held_count_;
  Pass(std::span<const Frame>(held_).first(std::exchange(held_count_, 0)));
}

int DatagramTransport::Pass(std::span<const Frame> frames) noexcept {
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
  if (drops_own_) own_dropped_ += taken;
  counters_.tx_refused += frames.size() - taken;
  return static_cast<int>(taken);
}

void DatagramTransport::NoteError(int error) noexcept {
  if (MeansBusLost(error)) alive_ = false;
}

}  // namespace reed::bus
