#include "reed/plant/faults/trigger.h"

#include <algorithm>
#include <cmath>

#include "reed/plant/drive/drive_state.h"

namespace reed::plant {
namespace {

constexpr double kRounding_s = 1e-9;  // a sum of periods may end just short of the instant it means

std::int64_t Cycles(double seconds, double rate_hz) { return std::llround(seconds * rate_hz); }

std::size_t IndexOf(const std::string& id, const std::vector<FaultConfig>& faults) {
  const auto found = std::find_if(faults.begin(), faults.end(), [&](const auto& f) { return f.id == id; });
  return static_cast<std::size_t>(found - faults.begin());
}

/// "joint3.angle_rad" -> 2; -1: another text.
int JointOf(const std::string& name) {
  const bool one =
      name.size() > 7 && name.starts_with("joint") && name[6] == '.' && name[5] >= '1' && name[5] <= '9';
  return one ? name[5] - '1' : -1;
}

}  // namespace

int DriveStateNamed(const std::string& name) {
  for (int state = 0; state <= static_cast<int>(bus::DriveState::kFault); ++state)
    if (name == Name(static_cast<bus::DriveState>(state))) return state;
  return -1;
}

bool Signal::Known(const std::string& name, int dof) {
  return Signal(name).what_ != What::kNone && (JointOf(name) < dof);
}

Signal::Signal(const std::string& name) {
  const int joint = JointOf(name);
  const std::string rest = joint < 0 ? name : name.substr(7);
  joint_ = std::max(joint, 0);
  if (joint < 0 && name == "normal_force_N") what_ = What::kNormalForce;
  if (joint < 0 && name == "gap_m") what_ = What::kGap;
  if (joint < 0 && name == "tip_speed_mps") what_ = What::kTipSpeed;
  if (joint >= 0 && rest == "angle_rad") what_ = What::kAngle;
  if (joint >= 0 && rest == "speed_radps") what_ = What::kSpeed;
}

double Signal::Of(const Truth& truth) const noexcept {
  switch (what_) {
    case What::kNormalForce:
      return truth.normal_force_N;
    case What::kGap:
      return truth.gap_m;
    case What::kTipSpeed:
      return truth.tip_velocity_mps.norm();
    case What::kAngle:
      return truth.motor_angle_rad[joint_];
    case What::kSpeed:
      return truth.motor_speed_radps[joint_];
    case What::kNone:
      break;
  }
  return 0.0;
}

Trigger::Trigger(const FaultConfig& config, const std::vector<FaultConfig>& faults, double rate_hz)
    : by_(By::kTime),
      from_s_(config.from_s),
      from_cycle_(config.from_cycle),
      signal_(config.signal),
      sign_(config.edge == FaultConfig::Edge::kRising ? 1.0 : -1.0),
      level_(config.level),
      for_cycles_(Cycles(config.for_s, rate_hz)),
      delay_cycles_(Cycles(config.delay_s, rate_hz)),
      duration_cycles_(Cycles(config.duration_s, rate_hz)),
      once_(config.once) {
  if (config.from_cycle >= 0) by_ = By::kCycle;
  if (!config.signal.empty()) by_ = By::kSignal;
  if (const int mode = DriveStateNamed(config.from_mode); mode >= 0) {
    by_ = By::kMode;
    mode_ = static_cast<bus::DriveState>(mode);
  }
  if (config.from_event.empty()) return;
  const auto* found = std::find(kHappenings.begin(), kHappenings.end(), config.from_event);
  by_ = found != kHappenings.end() ? By::kEvent : By::kFault;
  if (by_ == By::kEvent) event_ = static_cast<std::uint8_t>(1U << (found - kHappenings.begin()));
  if (by_ == By::kFault) fault_ = IndexOf(config.from_event, faults);
}

bool Trigger::Step(const Scene& scene) noexcept {
  const bool pulls = Pulls(scene);
  if (pulls && !spent_) {
    begin_ = scene.cycle + delay_cycles_;
    spent_ = once_;
  }
  return Pass(scene.cycle);
}

bool Trigger::Pass(std::int64_t cycle) noexcept {
  cycle_ = cycle;
  if (begin_ == kNever || cycle < begin_) return false;
  return duration_cycles_ == 0 || cycle < begin_ + duration_cycles_;
}

/// Once per edge of its condition.
bool Trigger::Pulls(const Scene& scene) noexcept {
  bool is = false;
  switch (by_) {
    case By::kTime:
      is = scene.enabled_for_s >= 0.0 && scene.enabled_for_s + kRounding_s >= from_s_;
      break;
    case By::kCycle:
      is = scene.cycle >= from_cycle_;
      break;
    case By::kMode:
      is = scene.drives == mode_;
      break;
    case By::kEvent:
      return (scene.happened & event_) != 0;
    case By::kFault:
      return scene.begun[fault_];
    case By::kSignal:
      is = BySignal(scene.truth);
      break;
  }
  const bool edge = is && !was_;
  was_ = is;
  return edge;
}

bool Trigger::BySignal(const Truth& truth) noexcept {
  const bool beyond = sign_ * (signal_.Of(truth) - level_) > 0.0;
  beyond_ = beyond ? beyond_ + 1 : 0;
  return beyond_ > for_cycles_;
}

}  // namespace reed::plant
