// A received value together with how old it is and how it arrived. RT: safe.
#pragma once

#include <cstdint>
#include <limits>

#include "bus/e2e_profile5.h"

namespace reed::bus {

template <typename T>
class Sampled {
 public:
  /// Age of a value that was never received; ages stop here instead of wrapping.
  static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

  /// Takes a usable value: its age becomes 0.
  void Set(const T& value, E2eState e2e) noexcept {
    value_ = value;
    e2e_ = e2e;
    age_cycles_ = 0;
  }
  /// Notes that a frame came whose content may not be used: value and age stay.
  void Refuse(E2eState e2e) noexcept { e2e_ = e2e; }
  /// Once per cycle, before receiving.
  void Age() noexcept {
    if (age_cycles_ != kNever) ++age_cycles_;
  }

  const T& value() const noexcept { return value_; }
  std::uint32_t age_cycles() const noexcept { return age_cycles_; }
  E2eState e2e() const noexcept { return e2e_; }  // of the last frame, used or refused
  bool IsFresh(std::uint32_t max_age_cycles = 0) const noexcept {
    return age_cycles_ <= max_age_cycles && age_cycles_ != kNever;
  }

 private:
  T value_{};
  std::uint32_t age_cycles_ = kNever;
  E2eState e2e_ = E2eState::kNone;
};

}  // namespace reed::bus
