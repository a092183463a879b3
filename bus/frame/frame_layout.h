// What the generated reed_layout.h says about frames and signals. Plain data. RT: safe.
#pragma once

#include <cstdint>

namespace reed::bus {

struct FrameLayout {
  std::uint32_t id;       // 11-bit identifier
  std::uint8_t size;      // bytes on the bus
  std::uint16_t data_id;  // E2E profile 5 Data ID, part of the CRC, never sent
};

/// Closed interval of a float signal, in the signal's unit.
struct Bounds {
  double min;
  double max;
};

}  // namespace reed::bus
