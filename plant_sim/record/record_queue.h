// Bounded queue from the simulation to the publishing thread: one producer, one consumer, no lock, no heap
// after the constructor. head_ and tail_ only grow; their difference is the fill. RT: safe.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "reed/plant/record/records.h"

namespace reed::plant {

class RecordQueue {
 public:
  explicit RecordQueue(std::size_t capacity) : cells_(capacity) {}

  /// Producer. False when full.
  bool TryPush(const Record& record) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == cells_.size()) return false;
    cells_[tail % cells_.size()] = record;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Consumer. False when empty.
  bool TryPop(Record& record) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    record = cells_[head % cells_.size()];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

 private:
  std::vector<Record> cells_;
  alignas(64) std::atomic<std::size_t> tail_{0};
  alignas(64) std::atomic<std::size_t> head_{0};
};

}  // namespace reed::plant
