#include "reed/rt/heap_guard.h"

#include <cerrno>
#include <cstdlib>

#ifdef REED_SANITIZED
#define REED_HEAP_GUARD 0
#else
#define REED_HEAP_GUARD 1
#endif

namespace {

// constinit: plain words in the executable's static TLS block, so that touching them can neither allocate nor
// run code.
constinit thread_local bool t_counting = false;
constinit thread_local std::int64_t t_calls = 0;
using Witness = void (*)() noexcept;
constinit Witness g_witness = nullptr;

}  // namespace

namespace reed::rt {

HeapCount::HeapCount() noexcept {
  t_calls = 0;
  t_counting = true;
}
HeapCount::~HeapCount() { t_counting = false; }
std::int64_t HeapCount::calls() const noexcept { return t_calls; }
void HeapCount::SetWitness(void (*witness)() noexcept) noexcept { g_witness = witness; }
HeapPause::HeapPause() noexcept : counting_(t_counting) { t_counting = false; }
HeapPause::~HeapPause() { t_counting = counting_; }
bool HeapCount::Works() noexcept { return REED_HEAP_GUARD != 0; }

}  // namespace reed::rt

#if REED_HEAP_GUARD

namespace {

void Count() noexcept {
  if (!t_counting) return;
  ++t_calls;
  if (g_witness != nullptr) g_witness();
}

bool IsPowerOfTwo(std::size_t n) noexcept { return n != 0 && (n & (n - 1)) == 0; }

}  // namespace

// The names are glibc's and the C standard's.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {

void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t count, std::size_t size) noexcept;
void* __libc_realloc(void* block, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;
void __libc_free(void* block) noexcept;

void* malloc(std::size_t size) noexcept {
  Count();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  Count();
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) noexcept {
  Count();
  return __libc_realloc(block, size);
}

void free(void* block) noexcept {
  Count();
  __libc_free(block);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  Count();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  Count();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
  Count();
  if (!IsPowerOfTwo(alignment) || alignment % sizeof(void*) != 0) return EINVAL;
  void* const got = __libc_memalign(alignment, size);
  if (got == nullptr) return ENOMEM;
  *block = got;
  return 0;
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

#endif
