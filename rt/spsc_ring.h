// Wait-free ring between exactly one producer thread and one consumer thread. Items are plain data, copied in
// and out or written and read in place. A full ring refuses: the producer is never delayed and counts what it
// lost. RT: construction is set-up only (it allocates and touches every page); everything else is safe.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace reed::rt {

/// Two threads that write to the same cache line slow each other down by an order of magnitude. A constant,
/// because std::hardware_destructive_interference_size may differ between translation units.
inline constexpr std::size_t kCacheLine = 64;

template <typename T>
class SpscRing {
  static_assert(std::is_trivially_copyable_v<T>, "an item crosses threads as plain bytes");

 public:
  /// Room for at least `min_capacity` items (rounded up to a power of two, so that a slot is a mask away).
  explicit SpscRing(std::size_t min_capacity)
      : capacity_(std::bit_ceil(min_capacity)), slots_(std::make_unique<T[]>(capacity_)) {}

  SpscRing(const SpscRing&) = delete;
  SpscRing& operator=(const SpscRing&) = delete;

  std::size_t capacity() const noexcept { return capacity_; }

  // ---- producer ----

  /// The slot that the next Publish() hands over, for filling in place; it still holds an old item.
  /// nullptr when the ring is full.
  T* Claim() noexcept {
    // relaxed: head_ is written by this thread only.
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_seen_ == capacity_) {
      // acquire: pairs with PopFront()'s release; the consumer's reads of the slot happen before it is
      // overwritten.
      tail_seen_ = tail_.load(std::memory_order_acquire);
      if (head - tail_seen_ == capacity_) return nullptr;
    }
    return &slots_[head & (capacity_ - 1)];
  }

  /// @pre Claim() returned a slot since the last Publish().
  void Publish() noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed) + 1;
    // release: the slot's content is visible to who reads this head.
    head_.store(head, std::memory_order_release);
    FetchAhead(slots_[(head + 1) & (capacity_ - 1)]);
  }

  /// False when the ring is full: the item is not in it.
  bool Push(const T& item) noexcept {
    T* slot = Claim();
    if (slot == nullptr) return false;
    *slot = item;
    Publish();
    return true;
  }

  // ---- consumer ----

  /// The oldest item, valid until PopFront(); nullptr when the ring is empty.
  const T* Front() noexcept {
    // relaxed: tail_ is written by this thread only.
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_seen_) {
      // acquire: pairs with Publish()'s release; the item is complete.
      head_seen_ = head_.load(std::memory_order_acquire);
      if (tail == head_seen_) return nullptr;
    }
    return &slots_[tail & (capacity_ - 1)];
  }

  /// @pre Front() returned an item since the last PopFront().
  void PopFront() noexcept {
    // release: our reads of the slot are over before the producer may see it as free.
    tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  bool Pop(T& item) noexcept {
    const T* front = Front();
    if (front == nullptr) return false;
    item = *front;
    PopFront();
    return true;
  }

 private:
  /// A slot lies in the caches of the thread that read it last. Asked for one item ahead, it comes while the
  /// producer does something else: a snapshot costs the loop three quarters of what it did.
  static void FetchAhead(T& slot) noexcept {
    constexpr std::size_t kMost = 2048;  // of a snapshot, what a cycle of few joints writes
    const char* bytes = reinterpret_cast<const char*>(&slot);
    for (std::size_t at = 0; at < std::min(sizeof(T), kMost); at += kCacheLine)
      __builtin_prefetch(bytes + at, 1);
  }

  // head_ and tail_ only grow (they wrap with the word, which the power of two divides), so full and empty
  // differ. Each side keeps the other's last seen index beside its own and rereads it only when it seems out
  // of luck.
  const std::size_t capacity_;
  const std::unique_ptr<T[]> slots_;
  alignas(kCacheLine) std::atomic<std::size_t> head_{0};  // items ever published
  std::size_t tail_seen_ = 0;                             // producer's
  alignas(kCacheLine) std::atomic<std::size_t> tail_{0};  // items ever popped
  std::size_t head_seen_ = 0;                             // consumer's
  static_assert(std::atomic<std::size_t>::is_always_lock_free);
};

}  // namespace reed::rt
