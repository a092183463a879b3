// Socket options with one-line errors. RT: set-up only; throws std::runtime_error.
#pragma once

#include <sys/socket.h>

#include <stdexcept>
#include <string>

#include "reed/rt/errno_text.h"

namespace reed::bus {

template <typename T>
void SetOption(int fd, int level, int name, const T& value, const char* what) {
  if (setsockopt(fd, level, name, &value, sizeof value) < 0) {
    throw std::runtime_error(std::string("socket option refused (") + what + "): " + rt::ErrnoText());
  }
}

/// A queue for a long pause of the reader, and a count of what did not fit even so. The kernel's
/// limit applies to whoever lacks CAP_NET_ADMIN: rmem_max, usually 208 KiB, about 300 frames.
inline void SetReceiveQueue(int fd) {
  constexpr int kBytes = 4 << 20;
  if (setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &kBytes, sizeof kBytes) < 0) {
    SetOption(fd, SOL_SOCKET, SO_RCVBUF, kBytes, "receive queue");
  }
  SetOption(fd, SOL_SOCKET, SO_RXQ_OVFL, 1, "count of overflows");
}

}  // namespace reed::bus
