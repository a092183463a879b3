// Kinetic energy of the mass along one bent element, (17) with a constant line density ρ:
//   E_k = 1/2 ∫ ρ ṙᵀṙ dl + 1/2 ∫ ρ_p (ω_x + φ' l/L)² dl,     ṙ = V + ω x r + r',   r = (l + u l/L - s, v, w)
// in the coordinates of the element and the quasi-velocities V, ω of its base frame (its own axes), complete
// to second order in the elastic coordinates. The integrals over l are done once, so that
//   E_k = 1/2 m V² + V·(ω x h) + 1/2 ωᵀ𝕀ω + V·h' + ω·G e' + 1/2 e'ᵀ M_ee e'
//   h = ∫ρ r dl     𝕀 = ∫ρ (r² 1 - r rᵀ) dl     G e' = ∫ρ r x r' dl
// and Lagrange's equations (19) in quasi-velocities follow term by term (docs/flexible_arm.md). RT: safe
// after construction.
#pragma once

#include "reed/plant/dynamics/section.h"

namespace reed::plant {

/// Material that counts only for motion relative to the element's base, 1/2 e'ᵀ M_rel e': what the link's
/// description has no mass for (a first link of which only the inertia about its axis is stated) still moves
/// when the member bends.
struct RelativeMass {
  double density = 0.0;  // kg/m
  double polar = 0.0;    // kg·m
};

class BeamInertia {
 public:
  BeamInertia() = default;
  /// `density` in kg/m, `polar` in kg·m: ρ_p, mass moment of inertia about the axis per length.
  BeamInertia(double length, double density, double polar, const RelativeMass& relative = {});

  void Deform(const ElasticVec& e, const ElasticVec& e_dot);

  /// ∂²E_k/∂(e', V, ω)², upper triangle only left of the base's columns.
  const BlockMat& mass_matrix() const { return M_; }

  /// Generalised forces [e | force | moment] that velocities and bias accelerations call for.
  BlockVec Bias(const Motion& base) const;

  double KineticEnergy(const Motion& base) const;
  double mass() const { return m_; }
  const Eigen::Vector3d& first_moment() const { return h_; }  // kg·m, about the base, its axes

  /// The undeformed element as a rigid body in the axes of its base.
  RigidBody AsRigidBody() const;

 private:
  // Integrals, constant.
  double length_ = 0.0, m_ = 0.0, polar_ = 0.0;
  double l_ = 0.0, ll_ = 0.0, U_ = 0.0, lU_ = 0.0, UU_ = 0.0;  // ∫ρ{l, l², l/L, l²/L, l²/L²} dl
  BendingVec N_, lN_, UN_;
  BendingMat NN_, S_, lS_;
  // State.
  ElasticVec e_, e_dot_;
  Eigen::Vector3d h_, h_dot_, h_bias_;
  Eigen::Matrix3d I_, I_dot_;
  BendingVec NNa_, NNb_, NNa_dot_, NNb_dot_, Sa_, Sb_, lSa_, lSb_, lNu_;
  BlockMat M_;
};

}  // namespace reed::plant
