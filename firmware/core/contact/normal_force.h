// The normal force: from the wrist sensor or from the momentum observer, without a step at a change of source.
// RT: safe.
//
//   sensor    f = nᵀ(F − zero), all in the sensor's axes and without the tool's weight, so that a zero taken in one pose
//             holds in every other. The zero is the mean of 64 readings at rest. It is taken again when frames return
//             and the arm touches nothing until the sensor is used again.
//   observer  f̂ = nᵀF̂ (50) − tare. The tare follows nᵀF̂ − f while the sensor is used, and nᵀF̂ in free motion:
//             slowly while the wall is sought. While the tip approaches it rises no faster than the error of the
//             weight can change with the motion of the tip. A wall is stiffer than that at any speed, so it does not
//             become the zero. The tare is held in contact without a sensor, also before force.start_s.
//   At a change of source the difference of both is added and decays with kForget_s.
#pragma once

#include <algorithm>

#include "reed/core/contact/force_source.h"
#include "reed/core/contact/mounted_sensor.h"
#include "reed/core/contact/wrench_tare.h"
#include "reed/math/exponential.h"

namespace reed::strategy {

class NormalForce {
 public:
  /// contact_N: an observed force that rises by more while the tip approaches is a wall and no new zero.
  NormalForce(const Eigen::Vector3d& normal, double contact_N, double T) noexcept
      : normal_(normal),
        contact_N_(contact_N),
        T_(T),
        tare_share_(-math::ExpM1(-T / kTare_s)),
        seek_share_(-math::ExpM1(-T / kSeek_s)),
        approach_share_(-math::ExpM1(-T / kApproach_s)),
        forget_(math::Exp(-T / kForget_s)) {}

  /// At rest and free. Here and below `read` is without the tool's weight, in the sensor's axes. valid: of now, and no
  /// axis at the end of its range.
  void Tare(const model::Wrench& read, bool valid) noexcept {
    if (valid) zero_.Take(read);
    carried_ = 0.0;
    tare_ = 0.0;
    starting_s_ = kStart_s;
  }
  /// The environment on the sensor, all axes, tared; as read before the tare is complete.
  model::Wrench Felt(const model::Wrench& read) const noexcept { return zero_.Felt(read); }
  /// By how much the zero differs from what a sensor that touches nothing reads, N.
  double ZeroOffset() const noexcept { return zero_.Force(); }
  bool tared() const noexcept { return zero_.complete(); }

  /// The frames are back: a new zero from the first of them, if the arm was free until the last one that the
  /// source waits for. That wait is longer than the rise of a contact. An arm that met the wall meanwhile keeps
  /// its old zero, or the wall's force would become the zero.
  void Retare(const model::Wrench& read, int fresh_in_row, bool free) noexcept {
    if (fresh_in_row == 1) {
      returned_ = {};
      stayed_free_ = true;
    }
    stayed_free_ = stayed_free_ && free;
    returned_.Take(read);
    if (stayed_free_ && fresh_in_row == SourceSelector::kReturnCycles - 1) zero_ = returned_;
  }

  /// The observed force rose as it does when the tip meets a wall: a contact before force.start_s.
  bool met_wall() const noexcept { return met_; }

  /// read: of the sensor (held while frames are missing). observed: F̂ (50), world axes. N. tip: its velocity, m/s.
  double Step(ForceSource source, const SensorReading& read, const Eigen::Vector3d& observed, bool in_contact,
              const Eigen::Vector3d& tip = Eigen::Vector3d::Zero()) noexcept {
    approach_ += approach_share_ * (-normal_.dot(tip) - approach_);
    const bool approaches = approach_ > kApproaching_mps;
    const bool sensor = source == ForceSource::kKnown;
    const double by_sensor = read.normal.dot(zero_.Apply(read.force));
    const double by_observer = normal_.dot(observed);
    if (sensor) tare_ += tare_share_ * (by_observer - by_sensor - tare_);
    const bool rises = !sensor && by_observer - tare_ > contact_N_;
    met_ = rises && (met_ || approaches);
    if (!sensor && !in_contact && !met_) {
      const double share = source == ForceSource::kObserver ? seek_share_ : tare_share_;
      tare_ += std::min(share * (by_observer - tare_), MostRise(approaches, tip.norm()));
    }
    const double raw = sensor ? by_sensor : by_observer - tare_;
    carried_ *= forget_;
    if (sensor != sensor_before_ && in_contact) carried_ = f_ - raw;
    sensor_before_ = sensor;
    f_ = raw + carried_;
    return f_;
  }

 private:
  /// Of the tare in a period, N. At the start the observer itself is on its way to the weight's error.
  double MostRise(bool approaches, double tip_speed) noexcept {
    if (starting_s_ > 0.0) starting_s_ -= T_;
    const bool bounded = approaches && starting_s_ <= 0.0;
    return bounded ? T_ * (kWeight_Npm * tip_speed + kDrift_Nps) : kNoBound_N;
  }

  static constexpr double kWeight_Npm =
      100.0;  // several times the error of an arm's weight; a soft wall has 500 N/m
  static constexpr double kDrift_Nps = 0.02;  // of what is left, such as the adapted friction
  static constexpr double kStart_s = 0.2;
  static constexpr double kNoBound_N = 1e12;
  static constexpr double kTare_s = 0.1;  // faster than the weight changes
  static constexpr double kSeek_s = 1.0;  // while the wall is sought: slower than the rise of a contact
  static constexpr double kApproaching_mps = 0.1e-3, kApproach_s = 0.02;
  static constexpr double kForget_s = 0.2;  // ten times slower than the force loop
  Eigen::Vector3d normal_;
  double contact_N_;
  double T_;
  double tare_share_, seek_share_, approach_share_, forget_;
  WrenchTare zero_, returned_;
  bool stayed_free_ = false;
  double starting_s_ = kStart_s;
  double approach_ = 0.0;  // normal speed of the tip into the wall, filtered, m/s
  double tare_ = 0.0, carried_ = 0.0, f_ = 0.0;
  bool sensor_before_ = true;
  bool met_ = false;  // a wall, before force.start_s
};

}  // namespace reed::strategy
