// What a drive says of itself and what may be asked of it, whatever the bus. RT: safe.
#pragma once

#include <cstdint>

namespace reed {

/// kBraked: commands had stopped for too long, the drive closed its brake by itself.
enum class DriveState : std::uint8_t { kOff = 0, kReady = 1, kEnabled = 2, kBraked = 3, kFault = 4 };

enum class DriveRequest : std::uint8_t { kOff = 0, kReady = 1, kEnable = 2 };

}  // namespace reed
