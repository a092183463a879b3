// Counts the heap calls of the calling thread, in release builds too: linking the object library
// reed_heap_guard replaces malloc, calloc, realloc, free and the aligned family by functions that count and
// pass on to glibc. Other threads are not counted, and pay one thread-local test per call. RT: safe.
#pragma once

#include <cstdint>

namespace reed::rt {

/// Counts from construction to destruction on this thread. One at a time per thread.
class HeapCount {
 public:
  HeapCount() noexcept;
  ~HeapCount();
  HeapCount(const HeapCount&) = delete;
  HeapCount& operator=(const HeapCount&) = delete;

  /// Calls of the malloc family on this thread since construction; free(nullptr) counts too.
  std::int64_t calls() const noexcept;

  /// Called at every counted call; nullptr: none. For proofs that name the caller.
  static void SetWitness(void (*witness)() noexcept) noexcept;

  /// False in a sanitizer's build, which has its own allocator: calls() is 0 and proves nothing there.
  static bool Works() noexcept;
};

/// What this thread does for somebody else while this lives is not counted.
class HeapPause {
 public:
  HeapPause() noexcept;
  ~HeapPause();
  HeapPause(const HeapPause&) = delete;
  HeapPause& operator=(const HeapPause&) = delete;

 private:
  bool counting_;
};

}  // namespace reed::rt
