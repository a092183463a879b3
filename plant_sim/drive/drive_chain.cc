#include "reed/plant/drive/drive_chain.h"

#include <algorithm>
#include <cmath>

#include "reed/plant/drive/drive_state.h"

namespace reed::plant {

DriveChain::DriveChain(const TrueArm& arm, const DriveConfig& config)
    : timeout_periods_(config.command_timeout_cycles), torque_Nm_(Eigen::VectorXd::Zero(arm.dof())) {
  for (const double limit_Nm : arm.torque_limit_Nm) outputs_.emplace_back(limit_Nm, config.torque_bits);
}

void DriveChain::Reset() noexcept {
  request_ = bus::DriveRequest::kOff;
  silent_periods_ = 0.0;
  Enter(bus::DriveState::kOff);
}

bool DriveChain::Command(bus::DriveRequest request, std::span<const double> torque_Nm,
                         double fastest_radps) noexcept {
  const auto used = torque_Nm.first(outputs_.size());
  if (!std::all_of(used.begin(), used.end(), [](double tau) { return std::isfinite(tau); })) return false;

  silent_periods_ = 0.0;
  Enter(AfterCommand(state_, request_, request, fastest_radps < kRestSpeed_radps));
  request_ = request;
  if (!braked()) {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      torque_Nm_[static_cast<Eigen::Index>(i)] = outputs_[i].Apply(used[i]);
    }
  }
  return true;
}

void DriveChain::Silence(double periods) noexcept {
  silent_periods_ += periods;
  if (silent_periods_ >= timeout_periods_) Enter(AfterSilence(state_));
}

void DriveChain::Fault() noexcept { Enter(bus::DriveState::kFault); }

bool DriveChain::braked() const noexcept { return BrakesClosed(state_); }

void DriveChain::Enter(bus::DriveState state) noexcept {
  state_ = state;
  if (braked()) torque_Nm_.setZero();
}

}  // namespace reed::plant
