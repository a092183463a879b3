// What a plant says at its beginning and its end. For the program that is alone on its side of the bus and
// for the one that holds both sides. RT: set-up only.
#pragma once

#include <string>

#include "reed/plant/endpoint/endpoint.h"
#include "reed/plant/record/publisher.h"

namespace reed::plant {

/// A line on standard output at once, unless `quiet`.
void Say(bool quiet, const std::string& line);

/// Completes the record, says what was done and what failed, returns the exit status.
int Conclude(const Endpoint& endpoint, Publisher& publisher, bool quiet);

}  // namespace reed::plant
