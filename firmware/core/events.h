// What happened in a cycle, for whoever records it. RT: safe.
#pragma once

#include <array>
#include <cstdint>

#include "reed/core/contact/force_source.h"
#include "reed/core/safety/mode_table.h"
#include "reed/core/safety/reason.h"

namespace reed {

struct Event {
  protect::Reason code = protect::Reason::kNone;
  int joint = -1;      // 0-based, -1: not about one joint
  double value = 0.0;  // unit: that of the reason's text
  mode::Mode mode = mode::Mode::kOff;
  strategy::ForceSource source = strategy::ForceSource::kNone;
};

/// Of a trip: the joint, 0-based, -1 for none in particular, and the value in the unit of its text.
struct TripPlace {
  int joint = -1;
  double value = 0.0;
};

/// The events of one cycle. What finds no room is left out: the first is the cause, the rest are its consequences.
class EventList {
 public:
  void Clear() noexcept { count_ = 0; }
  void Add(const Event& event) noexcept {
    if (count_ < kMost) events_[static_cast<std::size_t>(count_++)] = event;
  }
  const Event* begin() const noexcept { return events_.data(); }
  const Event* end() const noexcept { return events_.data() + count_; }

 private:
  static constexpr int kMost = 8;
  std::array<Event, kMost> events_{};
  int count_ = 0;
};

}  // namespace reed
