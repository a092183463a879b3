// Where a fault sits. RT: safe, except ParseTarget.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace reed::plant {

/// A bit each, so that a kind can name all that it fits.
enum class Seat : std::uint32_t {
  kEncoder = 1U << 0U,       // position, and the speed that the drive makes of it
  kSpeed = 1U << 1U,         // the speed alone
  kTorqueReport = 1U << 2U,  // the torque that a drive says it applies
  kForce = 1U << 3U,         // of the wrist
  kJointFrame = 1U << 4U,
  kWrenchFrame = 1U << 5U,
  kSyncFrame = 1U << 6U,
  kCommandFrame = 1U << 7U,
  kBus = 1U << 8U,    // every frame
  kDrive = 1U << 9U,  // the torque
  kBrake = 1U << 10U,
  kNode = 1U << 11U,  // a drive as a whole
  kController = 1U << 12U,
};

constexpr std::uint32_t operator|(Seat a, Seat b) noexcept {
  return static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b);
}
constexpr std::uint32_t operator|(std::uint32_t a, Seat b) noexcept {
  return a | static_cast<std::uint32_t>(b);
}
constexpr bool Fits(std::uint32_t seats, Seat seat) noexcept {
  return (seats & static_cast<std::uint32_t>(seat)) != 0;
}

inline constexpr std::uint32_t kSignals = Seat::kEncoder | Seat::kSpeed | Seat::kTorqueReport | Seat::kForce;
inline constexpr std::uint32_t kSentFrames = Seat::kJointFrame | Seat::kWrenchFrame;
inline constexpr std::uint32_t kFrames = kSentFrames | Seat::kSyncFrame | Seat::kCommandFrame | Seat::kBus;

struct Target {
  Seat seat = Seat::kBus;
  int joint = -1;  // 0-based; -1: all, or not about joints
  int axis = -1;   // of the wrench; -1: all

  bool Has(int of_joint) const noexcept { return joint < 0 || joint == of_joint; }
  /// Calls f(joint) for each that it is about, of an arm with `dof`.
  template <typename Call>
  void ForEachJoint(int dof, Call f) const noexcept {
    for (int i = 0; i < dof; ++i)
      if (Has(i)) f(i);
  }
  /// A frame's identifier is the target's.
  bool Carries(std::uint32_t id) const noexcept;
};

/// Nothing where the text names no target.
std::optional<Target> ParseTarget(const std::string& text);

/// For people: the targets that a kind fits, as patterns of text.
std::string TargetNames(std::uint32_t seats);

}  // namespace reed::plant
