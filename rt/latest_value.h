// The latest value from one writer thread to one reader thread: three buffers, one exchange on each side, so
// both are wait-free and neither ever sees half a value. Older values are lost on purpose. RT: safe.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

#include "reed/rt/spsc_ring.h"

namespace reed::rt {

/// At any time each of the three buffers has one owner: the writer (back), the reader (front), or the middle,
/// which changes hands through one atomic byte that also says whether its content is newer than the reader's.
template <typename T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>, "a value crosses threads as plain bytes");

 public:
  explicit LatestValue(const T& initial = T{}) noexcept {
    for (Buffer& buffer : buffers_) buffer.value = initial;
  }

  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer thread only.
  void Write(const T& value) noexcept {
    buffers_[back_].value = value;
    // release: the value is complete for the reader. acquire: the reader's last use of the buffer we get is
    // over.
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader thread only. The reference stays valid and constant until the next Read().
  const T& Read() noexcept {
    // relaxed: only a hint whether to exchange; a stale answer yields the previous value, which was the
    // latest then.
    if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    }
    return buffers_[front_].value;
  }

 private:
  static constexpr std::uint8_t kFresh = 4, kIndex = 3;
  struct alignas(kCacheLine) Buffer {
    T value;
  };
  std::array<Buffer, 3> buffers_;
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{1};
  alignas(kCacheLine) std::uint8_t back_ = 0;   // writer's
  alignas(kCacheLine) std::uint8_t front_ = 2;  // reader's
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);
};

}  // namespace reed::rt
