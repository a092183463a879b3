// SIGINT and SIGTERM as a question that a loop can ask. RT: safe after Install.
#pragma once

#include <cstdint>

namespace reed::plant {

/// From here on both signals are remembered instead of ending the process.
void InstallStopSignals();
bool StopRequested() noexcept;

/// A plant that waits for frames asks this often.
inline constexpr std::int64_t kStopCheck_ns = 60'000'000;

}  // namespace reed::plant
