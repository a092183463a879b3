// The disturbance that the momentum observer (47) sees, with the nominal model it compares against. RT: safe.
#pragma once

#include <numbers>

#include "reed/core/estimate/observer.h"
#include "reed/core/law/friction.h"
#include "reed/core/measurement.h"
#include "reed/core/model/dynamics.h"
#include "reed/math/exponential.h"

namespace reed::strategy {

template <int N, int P>
class DisturbanceEstimate {
 public:
  /// p_0: the frozen parameters. K_o: 1/s. filter_hz: of the drives' velocity. T: s.
  DisturbanceEstimate(const model::ArmModel<N, P>& arm, const model::Vec<P>& p_0, double K_o,
                      double filter_hz, double T) noexcept
      : arm_(arm),
        observer_(K_o, T),
        nominal_(model::BodiesFor<N, P>(arm, p_0)),
        viscous_(model::ViscousFriction<N, P>(arm, p_0)),
        rate_share_(-math::ExpM1(-2.0 * std::numbers::pi * filter_hz * T)) {}

  /// The arm is at rest and free: r = 0. kin: at the measured state.
  void Reset(const model::Kinematics<N>& kin, const model::Vec<N>& theta_dot) noexcept {
    observer_.Reset(Momentum(kin, theta_dot).momentum);
    rate_.setZero();
  }

  /// More than a period has passed since the last update: the rate of all of it is unknown.
  void NoteGap() noexcept { gap_ = true; }

  /// kappa: Coulomb friction as estimated, N·m. friction_speed: v_s (48), rad/s.
  void Update(const Measurement<N>& measured, const model::Kinematics<N>& kin, const model::Vec<N>& kappa,
              double friction_speed) noexcept {
    const model::MomentumModel<N> m = Momentum(kin, measured.theta_dot);
    kinetic_energy_ = 0.5 * m.momentum.dot(measured.theta_dot);
    const model::Vec<N> friction = viscous_.cwiseProduct(measured.theta_dot) +
                                   control::CoulombTorque<N>(kappa, measured.theta_dot, friction_speed);
    // The measured speed is filtered in the drive, so the known rate goes through the same filter: else every
    // change of the own torque would look like a force from outside.
    rate_ += rate_share_ * (measured.torque + m.free_rate - friction - rate_);
    if (gap_)
      observer_.Skip(m.momentum);
    else
      observer_.Update(m.momentum, rate_);  // (47)
    gap_ = false;
  }

  const model::Vec<N>& r() const noexcept { return observer_.r(); }   // N·m
  double kinetic_energy() const noexcept { return kinetic_energy_; }  // ½ pᵀ θ̇ of arm and rotors, J
  const model::Bodies<N>& nominal() const noexcept { return nominal_; }

 private:
  model::MomentumModel<N> Momentum(const model::Kinematics<N>& kin,
                                   const model::Vec<N>& theta_dot) const noexcept {
    model::MomentumModel<N> m = model::GeneralisedMomentum<N>(nominal_, kin, arm_.gravity);
    m.momentum += arm_.rotor_inertia.cwiseProduct(theta_dot);
    return m;
  }

  const model::ArmModel<N, P>& arm_;
  control::MomentumObserver<N> observer_;
  model::Bodies<N> nominal_;
  model::Vec<N> viscous_;
  double rate_share_;                           // of the drives' velocity filter, per cycle
  model::Vec<N> rate_ = model::Vec<N>::Zero();  // known part of the momentum's rate, filtered, N·m
  double kinetic_energy_ = 0.0;
  bool gap_ = false;
};

}  // namespace reed::strategy
