// The ring between the loop and the recorder's thread.
#pragma once

#include "reed/firmware/snapshot/snapshot.h"
#include "reed/rt/spsc_ring.h"

namespace reed::telemetry {

using SnapshotRing = rt::SpscRing<Snapshot>;

}  // namespace reed::telemetry
