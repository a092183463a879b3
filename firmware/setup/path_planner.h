// Legs of a scenario → the table of knots that the loop reads. Checks joint and speed limits on the way.
// Set-up only: allocates, throws ConfigError's base std::runtime_error with one line that names the rule.
#pragma once

#include <algorithm>
#include <vector>

#include "reed/config/controller/controller_config.h"
#include "reed/config/controller/fourier_leg.h"
#include "reed/core/reference/joint_path.h"
#include "reed/core/reference/minimum_jerk.h"
#include "reed/firmware/setup/inverse_kinematics.h"
#include "reed/firmware/setup/planned_path.h"
#include "reed/math/sine.h"

namespace reed::reference {

template <int N>
class PathPlanner {
 public:
  PathPlanner(PoseOf<N> pose_of, const ControllerConfig& scenario)
      : pose_of_(std::move(pose_of)), scenario_(scenario) {}

  PlannedPath<N> Plan() {
    CheckLegs();
    std::vector<model::Vec<N>> q = Sample();
    std::vector<typename JointPath<N>::Knot> knots = Differentiate(q);
    CheckLimits(knots);
    return {std::move(knots), kSpacing};
  }

 private:
  static constexpr double kSpacing = 0.005;  // s; a 5 Hz sinusoid of 1 rad is met to 1e-9 rad
  static constexpr double kBeyond = 3.0 * kSpacing;
  static constexpr double kRounding = 1e-9;             // s
  static constexpr double kShortest = 10.0 * kSpacing;  // of a leg that moves, and of a period
  static constexpr double kTwoPi = 6.283185307179586;

  /// Angles at every knot, leg after leg.
  std::vector<model::Vec<N>> Sample() {
    model::Vec<N> q = Eigen::Map<const model::Vec<N>>(scenario_.reference.start_rad.data());
    std::vector<model::Vec<N>> out{q};
    double t = 0.0, leg_start = 0.0;
    for (const ReferenceLeg& leg : scenario_.reference.legs) {
      const model::Vec<N> q_start = q;
      const model::Kinematics<N> kin = pose_of_(q_start);
      // A leg that moves when the run ends is followed a little further: the last knots' derivatives need it.
      const double leg_end = leg_start + leg.duration_s;
      const double sampled_to =
          leg_end + kRounding < scenario_.duration_s ? leg_end : scenario_.duration_s + kBeyond;
      const bool ends = sampled_to == leg_end;
      while (t + kSpacing <= sampled_to + kRounding) {
        t = kSpacing * static_cast<double>(out.size());
        q = AtLegTime(leg, t - leg_start, ends, q_start, kin, q);
        out.push_back(q);
      }
      leg_start += leg.duration_s;
      // The next leg starts where this one ends, also between two knots.
      if (ends && leg_start - t > kRounding) q = AtLegTime(leg, leg.duration_s, ends, q_start, kin, q);
    }
    while (out.size() < 5 || out.back() != q) out.push_back(q);  // the end of the last leg is a knot, too
    return out;
  }

  /// ends: the leg ends before the run does.
  model::Vec<N> AtLegTime(const ReferenceLeg& leg, double t, bool ends, const model::Vec<N>& q_start,
                          const model::Kinematics<N>& start, const model::Vec<N>& q_near) const {
    using Kind = ReferenceLeg::Kind;
    switch (leg.kind) {
      case Kind::kHold:
        return q_start;
      case Kind::kJoint: {
        const model::Vec<N> to = Eigen::Map<const model::Vec<N>>(leg.to_rad.data());
        return q_start + MinimumJerk(t, leg.duration_s).s * (to - q_start);
      }
      case Kind::kSine: {
        const model::Vec<N> amplitude = Eigen::Map<const model::Vec<N>>(leg.amplitude_rad.data());
        return q_start + Swing(leg, t, ends) * amplitude;
      }
      case Kind::kFourier: {
        model::Vec<N> q = q_start;
        for (int i = 0; i < N; ++i) q[i] += FourierOffset(leg, static_cast<std::size_t>(i), t);
        return q;
      }
      case Kind::kCartesian:
        return SolveInverseKinematics<N>(pose_of_, start.tip + MinimumJerk(t, leg.duration_s).s * leg.by_m,
                                         start.R_last(), q_near);
      case Kind::kSlide:
        return SolveInverseKinematics<N>(pose_of_, start.tip + Swing(leg, t, ends) * leg.amplitude_m,
                                         start.R_last(), q_near);
    }
    return q_start;
  }

  /// Sinusoid that fades in over its first half period and, if it ends within the run, out over its last one:
  /// it starts and ends at rest.
  static double Swing(const ReferenceLeg& leg, double t, bool ends) {
    if (leg.frequency_hz <= 0.0) return 0.0;
    const double half_s = 0.5 / leg.frequency_hz;
    const double sine = MinimumJerk(t, half_s).s * math::Sin(kTwoPi * leg.frequency_hz * t);
    return ends ? sine * MinimumJerk(leg.duration_s - t, half_s).s : sine;
  }

  static std::size_t HighestHarmonic(const ReferenceLeg& leg) {
    return leg.kind == ReferenceLeg::Kind::kFourier ? std::max(leg.sine_rad.size(), leg.cosine_rad.size())
                                                    : 1;
  }

  /// What is shorter than ten knots would be followed in part, or not at all.
  void CheckLegs() const {
    for (std::size_t i = 0; i < scenario_.reference.legs.size(); ++i) {
      const ReferenceLeg& leg = scenario_.reference.legs[i];
      if (leg.kind == ReferenceLeg::Kind::kHold) continue;
      const std::string key = "reference.legs[" + std::to_string(i) + "].";
      if (leg.duration_s < kShortest)
        throw std::runtime_error(key + "duration_s: " + std::to_string(leg.duration_s) +
                                 " s; allowed for a leg that moves: " + std::to_string(kShortest) +
                                 " s and more");
      const double highest_hz = leg.frequency_hz * static_cast<double>(HighestHarmonic(leg));
      if (highest_hz * kShortest > 1.0 + kRounding)
        throw std::runtime_error(key + "frequency_hz: " + std::to_string(highest_hz) +
                                 " Hz; allowed: up to " + std::to_string(1.0 / kShortest) + " Hz");
    }
  }

  /// Five-point differences: the samples are exact to 1e-13 rad, so speeds are to 1e-10 and accelerations to
  /// 1e-7.
  static std::vector<typename JointPath<N>::Knot> Differentiate(const std::vector<model::Vec<N>>& q) {
    const auto at = [&](std::ptrdiff_t k) -> const model::Vec<N>& {
      return q[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k, 0, std::ssize(q) - 1))];
    };
    std::vector<typename JointPath<N>::Knot> knots;
    for (std::ptrdiff_t k = 0; k < std::ssize(q); ++k) {
      const model::Vec<N> v = (at(k - 2) - 8.0 * at(k - 1) + 8.0 * at(k + 1) - at(k + 2)) / (12.0 * kSpacing);
      const model::Vec<N> a = (-at(k - 2) + 16.0 * at(k - 1) - 30.0 * at(k) + 16.0 * at(k + 1) - at(k + 2)) /
                              (12.0 * kSpacing * kSpacing);
      knots.push_back({at(k), v, a});
    }
    return knots;
  }

  void CheckLimits(const std::vector<typename JointPath<N>::Knot>& knots) const {
    const NominalArm& arm = scenario_.arm;
    for (std::size_t k = 0; k < knots.size(); ++k) {
      for (int i = 0; i < N; ++i) {
        const double margin = scenario_.limits.position_margin_rad;
        const std::string where = "reference.legs: joint " + std::to_string(i + 1) + " at " +
                                  std::to_string(kSpacing * static_cast<double>(k)) + " s: ";
        if (knots[k].q[i] < arm.position_min_rad[static_cast<std::size_t>(i)] + margin ||
            knots[k].q[i] > arm.position_max_rad[static_cast<std::size_t>(i)] - margin)
          throw std::runtime_error(
              where + std::to_string(knots[k].q[i]) + " rad is beyond its limit; allowed: " +
              std::to_string(arm.position_min_rad[static_cast<std::size_t>(i)] + margin) + " ... " +
              std::to_string(arm.position_max_rad[static_cast<std::size_t>(i)] - margin) + " rad");
        const double speed =
            scenario_.limits.speed_scale * arm.speed_limit_radps[static_cast<std::size_t>(i)];
        if (std::abs(knots[k].q_dot[i]) > speed)
          throw std::runtime_error(where + std::to_string(knots[k].q_dot[i]) +
                                   " rad/s is too fast; allowed: up to " + std::to_string(speed) + " rad/s");
      }
    }
  }

  PoseOf<N> pose_of_;
  const ControllerConfig& scenario_;
};

}  // namespace reed::reference
