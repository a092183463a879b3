// How much stack the process's ordinary threads get. RT: set-up only.
#pragma once

#include <pthread.h>

#include <cstddef>

namespace reed::rt {

/// Of every thread that is started later. Locking the memory of a process maps all of its stacks, and the
/// usual 8 MiB of each thread cost as much time at start as a quarter of a second of lockstep.
inline void UseSmallThreadStacks() noexcept {
  constexpr std::size_t kStackBytes = std::size_t{1024} * 1024;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

}  // namespace reed::rt
