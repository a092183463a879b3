#include "reed/plant/dynamics/beam_inertia.h"

#include "reed/plant/dynamics/processor_clones.h"
#include "reed/plant/dynamics/small_products.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;

BeamInertia::BeamInertia(double length, double density, double polar, const RelativeMass& relative)
    : length_(length),
      m_(density * length),
      polar_(polar),
      l_(density * length * length / 2.0),
      ll_(density * length * length * length / 3.0),
      U_(density * length / 2.0),
      lU_(density * length * length / 3.0),
      UU_(density * length / 3.0) {
  const BeamIntegrals integrals = IntegrateShapes(length);
  N_ = density * integrals.N;
  lN_ = density * integrals.lN;
  UN_ = lN_ / length;
  NN_ = density * integrals.NN;
  S_ = density * integrals.S;
  lS_ = density * integrals.lS;

  // What does not change with e: to second order in E_k, M_ee is constant.
  M_.setZero();
  M_.block<kBending, kBending>(kA, kA) = NN_ + relative.density * integrals.NN;
  M_.block<kBending, kBending>(kB, kB) = NN_ + relative.density * integrals.NN;
  M_(kU, kU) = UU_ + relative.density * length / 3.0;
  M_(kTwist, kTwist) = (polar_ + relative.polar) * length / 3.0;
  M_(kTwist, kAngular) = polar_ * length / 2.0;
  M_.block<3, 3>(kLinear, kLinear) = m_ * Matrix3d::Identity();
  M_.block<kBending, 1>(kA, kLinear + 1) = N_;
  M_.block<kBending, 1>(kB, kLinear + 2) = N_;
  M_(kU, kLinear) = U_;
  Deform(ElasticVec::Zero(), ElasticVec::Zero());
}

REED_CLONES void BeamInertia::Deform(const ElasticVec& e, const ElasticVec& e_dot) {
  e_ = e;
  e_dot_ = e_dot;
  const BendingVec a = e.segment<kBending>(kA), b = e.segment<kBending>(kB);
  const BendingVec a_dot = e_dot.segment<kBending>(kA), b_dot = e_dot.segment<kBending>(kB);
  const double u = e[kU], u_dot = e_dot[kU];

  NNa_ = Times(NN_, a);
  NNb_ = Times(NN_, b);
  NNa_dot_ = Times(NN_, a_dot);
  NNb_dot_ = Times(NN_, b_dot);
  Sa_ = Times(S_, a);
  Sb_ = Times(S_, b);
  lSa_ = Times(lS_, a);
  lSb_ = Times(lS_, b);
  lNu_ = lN_ + u * UN_;

  // h, its rate, and its second derivative without e''.
  h_ = {l_ + U_ * u - 0.5 * a.dot(Sa_) - 0.5 * b.dot(Sb_), N_.dot(a), N_.dot(b)};
  h_dot_ = {U_ * u_dot - Sa_.dot(a_dot) - Sb_.dot(b_dot), N_.dot(a_dot), N_.dot(b_dot)};
  h_bias_ = {-a_dot.dot(Times(S_, a_dot)) - b_dot.dot(Times(S_, b_dot)), 0.0, 0.0};

  // Second moments ∫ρ{x², y², z², xy, xz, yz} and their rates.
  const double xx = ll_ + (2.0 * lU_ + UU_ * u) * u - a.dot(lSa_) - b.dot(lSb_);
  const double yy = a.dot(NNa_), zz = b.dot(NNb_), yz = a.dot(NNb_);
  const double xy = lNu_.dot(a), xz = lNu_.dot(b);
  const double xx_dot = 2.0 * ((lU_ + UU_ * u) * u_dot - lSa_.dot(a_dot) - lSb_.dot(b_dot));
  const double yy_dot = 2.0 * NNa_.dot(a_dot), zz_dot = 2.0 * NNb_.dot(b_dot);
  const double yz_dot = NNb_.dot(a_dot) + NNa_.dot(b_dot);
  const double xy_dot = lNu_.dot(a_dot) + u_dot * UN_.dot(a), xz_dot = lNu_.dot(b_dot) + u_dot * UN_.dot(b);
  I_ << yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy;
  I_dot_ << yy_dot + zz_dot, -xy_dot, -xz_dot, -xy_dot, xx_dot + zz_dot, -yz_dot, -xz_dot, -yz_dot,
      xx_dot + yy_dot;

  // ∂h/∂e and G beside the constant part of the mass matrix.
  M_.block<kBending, 1>(kA, kLinear) = -Sa_;
  M_.block<kBending, 1>(kB, kLinear) = -Sb_;
  M_.block<kBending, 1>(kA, kAngular) = -NNb_;
  M_.block<kBending, 1>(kA, kAngular + 2) = lNu_;
  M_.block<kBending, 1>(kB, kAngular) = NNa_;
  M_.block<kBending, 1>(kB, kAngular + 1) = -lNu_;
  M_(kU, kAngular + 1) = UN_.dot(b);
  M_(kU, kAngular + 2) = -UN_.dot(a);
  M_.block<3, 3>(kLinear, kAngular) = -Cross(h_);
  M_.block<3, 3>(kAngular, kLinear) = Cross(h_);
  M_.block<3, 3>(kAngular, kAngular) = I_;
  M_(kAngular, kAngular) += polar_ * length_;
}

REED_CLONES BlockVec BeamInertia::Bias(const Motion& base) const {
  const Vector3d &w = base.omega, &acc = base.bias_linear, &alpha = base.bias_angular;
  const BendingVec a = e_.segment<kBending>(kA), b = e_.segment<kBending>(kB);
  const BendingVec a_dot = e_dot_.segment<kBending>(kA), b_dot = e_dot_.segment<kBending>(kB);
  const double u = e_[kU], u_dot = e_dot_[kU], UNa = UN_.dot(a), UNb = UN_.dot(b);
  const double wxx = w.x() * w.x(), wyy = w.y() * w.y(), wzz = w.z() * w.z();

  // Each row: its mass times the bias acceleration of the base, the columns of ∂h/∂e and G in the mass matrix. Then, of the
  // elastic rows, centrifugal -1/2 ω ∂𝕀/∂e ω and Coriolis -2 ω ∂(Ge')/∂e.
  BlockVec p;
  p.segment<kBending>(kA) = (alpha.z() + w.x() * w.y()) * lNu_ + (w.y() * w.z() - alpha.x()) * NNb_ +
                            acc.y() * N_ - acc.x() * Sa_ + (wyy + wzz) * lSa_ - (wxx + wzz) * NNa_ -
                            2.0 * w.x() * NNb_dot_ + 2.0 * w.z() * u_dot * UN_;
  p.segment<kBending>(kB) = (w.x() * w.z() - alpha.y()) * lNu_ + (w.y() * w.z() + alpha.x()) * NNa_ +
                            acc.z() * N_ - acc.x() * Sb_ + (wyy + wzz) * lSb_ - (wxx + wyy) * NNb_ +
                            2.0 * w.x() * NNa_dot_ - 2.0 * w.y() * u_dot * UN_;
  p[kU] = U_ * acc.x() + (alpha.y() + w.x() * w.z()) * UNb + (w.x() * w.y() - alpha.z()) * UNa -
          (wyy + wzz) * (lU_ + UU_ * u) + 2.0 * (w.y() * UN_.dot(b_dot) - w.z() * UN_.dot(a_dot));
  p[kTwist] = 0.5 * polar_ * length_ * alpha.x();

  // Base rows.
  const Vector3d Ge_dot(NNa_.dot(b_dot) - NNb_.dot(a_dot), UNb * u_dot - lNu_.dot(b_dot),
                        lNu_.dot(a_dot) - UNa * u_dot);
  const double spin = polar_ * length_ * (w.x() + 0.5 * e_dot_[kTwist]);
  p.segment<3>(kLinear) = m_ * acc + alpha.cross(h_) + w.cross(w.cross(h_)) + 2.0 * w.cross(h_dot_) + h_bias_;
  p.segment<3>(kAngular) = h_.cross(acc) + Times(I_, alpha) +
                           Vector3d(polar_ * length_ * alpha.x(), 0.0, 0.0) +
                           w.cross(Times(I_, w) + Ge_dot + Vector3d(spin, 0.0, 0.0)) + Times(I_dot_, w);
  return p;
}

double BeamInertia::KineticEnergy(const Motion& base) const {
  BlockVec rate;
  rate << e_dot_, base.velocity, base.omega;
  return 0.5 * rate.dot(M_.selfadjointView<Eigen::Upper>() * rate);
}

RigidBody BeamInertia::AsRigidBody() const {
  const double transverse = ll_ - m_ * length_ * length_ / 4.0;
  return {m_, Vector3d(0.5 * length_, 0.0, 0.0),
          Vector3d(polar_ * length_, transverse, transverse).asDiagonal()};
}

}  // namespace reed::plant
