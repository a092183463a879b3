// A frame whose content was changed on its way, made whole again to every check of its protection: what simulated faults and
// tests do, and no program that controls an arm. RT: safe.
#pragma once

#include <cstdint>
#include <span>

#include "reed/bus/codec/e2e_profile5.h"
#include "reed/bus/frame/frame.h"
#include "reed_layout.h"

namespace reed::bus {

inline std::uint8_t CounterOf(const Frame& frame) noexcept { return frame.data[2]; }

/// counter: the E2E counter that it gets. A frame of no layout stays as it is.
inline void Reprotect(Frame& frame, std::uint8_t counter) noexcept {
  for (const FrameLayout& layout : layout::kFrames)
    if (layout.id == frame.id) Protect(std::span(frame.data).first(frame.size), layout.data_id, counter);
}

}  // namespace reed::bus
