#include "reed/bus/transport/memory_transport.h"

#include <algorithm>

namespace reed::bus {

void MemoryTransport::Join(MemoryTransport& a, MemoryTransport& b) noexcept {
  a.peer_ = &b;
  b.peer_ = &a;
}

int MemoryTransport::Receive(std::span<Frame> out, int /*wanted*/, std::int64_t /*deadline_ns*/) noexcept {
  if (other_side_) other_side_();
  const std::size_t count = std::min(out.size(), inbox_.size());
  std::copy_n(inbox_.begin(), count, out.begin());
  inbox_.erase(inbox_.begin(), inbox_.begin() + static_cast<std::ptrdiff_t>(count));
  counters_.frames_rx += count;
  return static_cast<int>(count);
}

int MemoryTransport::Send(std::span<const Frame> frames) noexcept {
  if (!alive_) return 0;
  std::vector<Frame>& there = peer_->inbox_;
  const std::size_t taken =
      std::min(frames.size(), peer_->capacity_ - std::min(peer_->capacity_, there.size()));
  there.insert(there.end(), frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(taken));
  peer_->counters_.overflowed += frames.size() - taken;
  counters_.frames_tx += frames.size();
  return static_cast<int>(frames.size());
}

}  // namespace reed::bus
