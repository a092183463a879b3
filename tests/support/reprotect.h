// A frame whose content a test has changed, made sound again to every check of its protection.
#pragma once

#include <cstdint>
#include <span>

#include "reed/bus/codec/e2e_profile5.h"
#include "reed/bus/frame/frame.h"
#include "reed_layout.h"

namespace reed::test {

inline void Reprotect(bus::Frame& frame, std::uint8_t counter) {
  for (const bus::FrameLayout& layout : bus::layout::kFrames) {
    if (layout.id != frame.id) continue;
    bus::E2eSender sender;
    for (int i = 0; i <= counter; ++i)
      sender.Protect(std::span(frame.data).first(frame.size), layout.data_id);
  }
}

}  // namespace reed::test
