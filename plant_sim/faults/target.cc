#include "reed/plant/faults/target.h"

#include <array>

#include "reed_layout.h"

namespace reed::plant {
namespace {

struct TargetName {
  Seat seat;
  const char* text;
  int axis = -1;
};

constexpr std::array kOfAJoint{TargetName{Seat::kEncoder, "encoder"},
                               TargetName{Seat::kSpeed, "speed"},
                               TargetName{Seat::kTorqueReport, "torque"},
                               TargetName{Seat::kJointFrame, "frame"},
                               TargetName{Seat::kDrive, "drive"},
                               TargetName{Seat::kBrake, "brake"},
                               TargetName{Seat::kNode, "node"}};
constexpr std::array kOthers{
    TargetName{Seat::kForce, "wrench.force"},         TargetName{Seat::kForce, "wrench.force_x", 0},
    TargetName{Seat::kForce, "wrench.force_y", 1},    TargetName{Seat::kForce, "wrench.force_z", 2},
    TargetName{Seat::kWrenchFrame, "wrench.frame"},   TargetName{Seat::kSyncFrame, "sync.frame"},
    TargetName{Seat::kCommandFrame, "command.frame"}, TargetName{Seat::kBus, "bus"},
    TargetName{Seat::kController, "controller"}};

}  // namespace

bool Target::Carries(std::uint32_t id) const noexcept {
  const std::uint32_t first = bus::layout::kJointState[0].id;
  switch (seat) {
    case Seat::kJointFrame:
    case Seat::kNode:
      return id >= first && id < first + kMaxJoints && Has(static_cast<int>(id - first));
    case Seat::kWrenchFrame:
      return id == bus::layout::kWrench.id;
    case Seat::kSyncFrame:
      return id == bus::layout::kSync.id;
    case Seat::kCommandFrame:
    case Seat::kController:
      return id == bus::layout::kCommand.id;
    default:
      return seat == Seat::kBus;
  }
}

std::optional<Target> ParseTarget(const std::string& text) {
  for (const TargetName& name : kOthers)
    if (text == name.text) return Target{name.seat, -1, name.axis};
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string whose = text.substr(0, dot);
  const bool all = whose == "joints";
  const bool one = whose.size() == 6 && whose.starts_with("joint") && whose[5] >= '1' && whose[5] <= '9';
  if (!all && !one) return std::nullopt;
  for (const TargetName& name : kOfAJoint)
    if (text.substr(dot + 1) == name.text) return Target{name.seat, all ? -1 : whose[5] - '1', -1};
  return std::nullopt;
}

std::string TargetNames(std::uint32_t seats) {
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  for (const TargetName& name : kOfAJoint)
    if (Fits(seats, name.seat)) add("jointN." + std::string(name.text));
  for (const TargetName& name : kOthers)
    if (Fits(seats, name.seat) && name.axis < 0) add(name.text);
  return out;
}

}  // namespace reed::plant
