// The one place that turns a user's bus name into a transport. RT: set-up only.
#pragma once

#include <memory>
#include <string_view>

#include "reed/bus/transport/transport.h"

namespace reed::bus {

/// `name`: "socketcan:IFACE", "udp" or "udp:GROUP:PORT". Throws std::runtime_error with one line: what,
/// where, and the fix or what is allowed.
std::unique_ptr<Transport> OpenTransport(std::string_view name,
                                         Identifiers identifiers = Identifiers::kOfTheDbc);

/// From here on the calling thread alone receives from it, and waits with one system call where the kernel
/// can (uring_receiver.h). False: it cannot, or forbids it; two calls then do the same.
bool ReceiveOnThisThread(Transport& transport);

/// From here on what is sent leaves with the next Receive: in lockstep the command of a cycle and the SYNC of
/// the next have nothing to wait for between them. No difference on a bus in memory.
void SendWithNextReceive(Transport& transport);
/// At the end: what no Receive followed leaves now.
void SendHeld(Transport& transport);

}  // namespace reed::bus
