// SIGINT and SIGTERM as a question that a loop can ask. RT: safe after Install.
#pragma once

namespace reed::plant {

/// From here on both signals are remembered instead of ending the process.
void InstallStopSignals();
bool StopRequested() noexcept;

}  // namespace reed::plant
