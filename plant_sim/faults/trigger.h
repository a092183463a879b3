// When a fault begins and how long it acts. RT: safe.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/config/plant/fault_config.h"
#include "reed/plant/dynamics/arm_plant.h"

namespace reed::plant {

/// Bits: what happened since the last look.
enum class Happening : std::uint8_t {
  kContactMade = 1,
  kContactLost = 2,
  kBrakesReleased = 4,
  kBrakesClosed = 8
};
inline constexpr std::array<const char*, 4> kHappenings{"contact_made", "contact_lost", "brakes_released",
                                                        "brakes_closed"};

/// What a trigger looks at, once per cycle.
struct Scene {
  std::int64_t cycle = 0;
  double enabled_for_s = -1.0;  // negative: not yet
  bus::DriveState drives = bus::DriveState::kOff;
  std::uint8_t happened = 0;
  const std::vector<bool>& begun;  // by fault: in this cycle
  const Truth& truth;
};

/// A number of the true state by its name; nothing for an unknown name or a joint that the arm does not have.
class Signal {
 public:
  Signal() = default;
  static bool Known(const std::string& name, int dof);
  explicit Signal(const std::string& name);
  double Of(const Truth& truth) const noexcept;

 private:
  enum class What : std::uint8_t { kNone, kNormalForce, kGap, kTipSpeed, kAngle, kSpeed };
  What what_ = What::kNone;
  Eigen::Index joint_ = 0;
};

class Trigger {
 public:
  /// faults: of the whole scenario, where ids of others are found.
  Trigger(const FaultConfig& config, const std::vector<FaultConfig>& faults, double rate_hz);

  /// Whether the fault acts in this cycle, before its probability counts.
  bool Step(const Scene& scene) noexcept;
  /// A SYNC that only the bus has seen: time passes where faults keep the arm from hearing of it.
  bool Pass(std::int64_t cycle) noexcept;

  /// Of the window that acts: in its first cycle 0.
  int since() const noexcept { return static_cast<int>(cycle_ - begin_); }

 private:
  bool Pulls(const Scene& scene) noexcept;
  bool ByMode(const Scene& scene) noexcept;
  bool BySignal(const Truth& truth) noexcept;

  enum class By : std::uint8_t { kTime, kCycle, kMode, kEvent, kFault, kSignal };
  static constexpr std::int64_t kNever = -1;

  By by_;
  double from_s_;
  std::int64_t from_cycle_;
  bus::DriveState mode_ = bus::DriveState::kOff;
  std::uint8_t event_ = 0;
  std::size_t fault_ = 0;
  Signal signal_;
  double sign_, level_;
  std::int64_t for_cycles_, delay_cycles_, duration_cycles_;
  bool once_;

  bool was_ = false;  // the condition in the last cycle
  bool spent_ = false;
  std::int64_t beyond_ = 0;  // cycles beyond the level
  std::int64_t begin_ = kNever, cycle_ = 0;
};

/// The drives' state with this name; -1: none.
int DriveStateNamed(const std::string& name);

}  // namespace reed::plant
