// Waiting for a thread that may hang in a system call, and cannot be ended from outside. RT: set-up only.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace reed::rt {

/// How long a writer may make no progress before it is given up: longer than a busy disk does, and shorter than a person waits
/// after Ctrl-C.
inline constexpr std::int64_t kDiskPatience_ns = 3'000'000'000;

/// Waits until `done`. False: `progress` has not changed for `patience_ns`.
bool AwaitDone(const std::atomic<bool>& done, const std::atomic<std::int64_t>& progress,
               std::int64_t patience_ns = kDiskPatience_ns) noexcept;

/// What is said of a file that such a thread is stuck in.
std::string TakesNothing(const std::string& file);

/// Ends the process with this line and status 3, without destroying anything: a thread of it is stuck in the kernel for good.
[[noreturn]] void AbandonProcess(const std::string& line) noexcept;

}  // namespace reed::rt
