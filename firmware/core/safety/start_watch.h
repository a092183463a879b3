// An arm that shall start and does not: after two seconds it trips, which says why. Waiting longer would not help. RT: safe.
#pragma once

#include <algorithm>

#include "reed/core/measurement.h"
#include "reed/core/safety/limits.h"
#include "reed/core/safety/supervisor.h"

namespace reed::protect {

template <int N>
class StartWatch {
 public:
  explicit StartWatch(double T) noexcept : T_(T) {}

  /// Once per cycle.
  LimitCheck Check(const Measurement<N>& measured, const mode::Supervisor& supervisor) noexcept {
    const bool answers = measured.YoungestAge() < Measurement<N>::kNever;
    cycles_waiting_ = supervisor.awaits_start() && answers ? cycles_waiting_ + 1 : 0;
    if (cycles_waiting_ == 0) return {};
    const bool ready = supervisor.mode() == mode::Mode::kReady;
    // A drive may clear an old fault while it is asked for off; one in fault that is asked for ready stays there.
    if (ready && measured.AnyDrive(DriveState::kFault))
      return FirstDrive(measured, [](DriveState drive) { return drive == DriveState::kFault; });
    return cycles_waiting_ * T_ > kPatience_s ? Cause(measured, ready) : LimitCheck{};
  }

 private:
  static LimitCheck Cause(const Measurement<N>& measured, bool ready) noexcept {
    if (measured.OldestAge() > 0)
      return {Reason::kStaleMeasurement, measured.OldestJoint(), static_cast<double>(measured.OldestAge()),
              0};
    if (measured.AnyDrive(DriveState::kBraked))
      return FirstDrive(measured, [](DriveState drive) { return drive == DriveState::kBraked; });
    if (!ready) return {};  // they do answer
    if (!measured.AllDrives(DriveState::kReady))
      return FirstDrive(measured, [](DriveState drive) { return drive != DriveState::kReady; });
    return {Reason::kStaleWrench, -1, static_cast<double>(measured.wrench_age), 0};  // its zero is missing
  }

  template <typename Predicate>
  static LimitCheck FirstDrive(const Measurement<N>& measured, Predicate is_it) noexcept {
    const auto drive = std::find_if(measured.drive.begin(), measured.drive.end(), is_it);
    const auto joint = static_cast<int>(drive - measured.drive.begin());
    return {Reason::kDriveFault, joint, static_cast<double>(*drive), 0};
  }

  static constexpr double kPatience_s = 2.0;

  double T_;
  int cycles_waiting_ = 0;  // although an arm answers
};

}  // namespace reed::protect
