#include "reed/config/schema/loop_margin.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace reed {
namespace {

constexpr double kDamping = 0.01;          // of the motor-spring mode, of critical: less than any gearbox has
constexpr double kLeastInertia = 1e-4;     // of the rotor's: a link on its own axis has none
constexpr double kLargestGainMargin = 64;  // more is not told apart
constexpr int kStates = 7;  // θ θ̇ q q̇, ω, θ of the last sample, torque until the next one

// Of dynamic size: seven unrolled rows took 25 s to compile, and this runs once, at start.
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// exp(A) by scaling and squaring.
MatrixXd Exponential(MatrixXd A) {
  constexpr int kTerms = 18;
  const double norm = A.cwiseAbs().rowwise().sum().maxCoeff();
  const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(std::max(norm, 1e-300)))) + 1);
  A /= std::ldexp(1.0, squarings);
  MatrixXd sum = MatrixXd::Identity(A.rows(), A.cols()), term = sum;
  for (int k = 1; k <= kTerms; ++k) {
    term = term * A / k;
    sum += term;
  }
  for (int k = 0; k < squarings; ++k) sum = sum * sum;
  return sum;
}

/// One period of the loop as x⁺ = F x; the last row is the law.
MatrixXd PeriodOf(const JointLoop& loop) {
  const double J = loop.rotor_inertia_kgm2, M = std::max(loop.inertia_kgm2, kLeastInertia * J);
  const double k = loop.stiffness_Nmprad, T = loop.period_s;
  const double d = 2.0 * kDamping * k / std::sqrt(k * (1.0 / J + 1.0 / M));
  MatrixXd A = MatrixXd::Zero(5, 5);
  A.row(0) << 0.0, 1.0, 0.0, 0.0, 0.0;
  A.row(1) << -k / J, -d / J, k / J, d / J, 1.0 / J;
  A.row(2) << 0.0, 0.0, 0.0, 1.0, 0.0;
  A.row(3) << k / M, d / M, -k / M, -d / M, 0.0;
  const MatrixXd held = Exponential(A * T);
  MatrixXd F = MatrixXd::Zero(kStates, kStates);
  F.topLeftCorner(4, 4) = held.topLeftCorner(4, 4);
  F.topRightCorner(4, 1) = held.topRightCorner(4, 1);
  const double share = -std::expm1(-2.0 * std::numbers::pi * loop.velocity_filter_hz * T);
  F.row(4) << share / T, 0.0, 0.0, 0.0, 1.0 - share, -share / T, 0.0;
  F(5, 0) = 1.0;
  const double velocity_gain = loop.K_d + (loop.acceleration ? (M + J) * loop.Lambda : 0.0);
  F.row(6) = -velocity_gain * F.row(4);
  F(6, 0) -= loop.K_d * loop.Lambda;
  return F;
}

bool Stable(MatrixXd F, double gain) {
  F.row(6) *= gain;
  // F^(2^k): it vanishes or grows without bound. 2^24 periods tell a radius of 1 - 1e-6 from 1.
  for (int k = 0; k < 24; ++k) {
    F = (F * F).eval();
    const double size = F.cwiseAbs().maxCoeff();
    if (size < 1e-9) return true;
    if (!(size < 1e150)) return false;
  }
  return false;
}

double GainMargin(const MatrixXd& F) {
  double stable = 0.0, unstable = 1.0;
  if (Stable(F, 1.0)) {
    stable = 1.0;
    unstable = kLargestGainMargin;
    if (Stable(F, unstable)) return unstable;
  }
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (Stable(F, middle) ? stable : unstable) = middle;
  }
  return stable;
}

/// Least angle between the open loop and -1 wherever it has the size of 1.
double PhaseMargin(const MatrixXd& F, double period_s) {
  using Complex = std::complex<double>;
  constexpr int kPoints = 2000;
  MatrixXd open = F;
  open.row(6).setZero();
  const double highest = std::numbers::pi / period_s, lowest = 0.1;
  double least = std::numbers::pi, size_before = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double w = lowest * std::pow(highest / lowest, static_cast<double>(i) / (kPoints - 1));
    MatrixXcd zI_F = -open.cast<Complex>();
    zI_F.diagonal().array() += std::polar(1.0, w * period_s);
    Eigen::VectorXcd torque = Eigen::VectorXcd::Zero(kStates);
    torque[6] = 1.0;
    const Complex L = -(F.row(6).cast<Complex>() * zI_F.partialPivLu().solve(torque)).value();
    const double size = std::abs(L);
    if (i > 0 && (size_before - 1.0) * (size - 1.0) <= 0.0) least = std::min(least, std::abs(std::arg(-L)));
    size_before = size;
  }
  return least * 180.0 / std::numbers::pi;
}

}  // namespace

LoopMargin MarginOf(const JointLoop& loop) {
  const MatrixXd F = PeriodOf(loop);
  const double gain = GainMargin(F);
  return {gain, gain < 1.0 ? 0.0 : PhaseMargin(F, loop.period_s)};
}

bool Enough(const LoopMargin& margin, const LoopMargin& needed) {
  return margin.gain >= needed.gain && margin.phase_deg >= needed.phase_deg;
}

double LargestKd(JointLoop loop, const LoopMargin& needed) {
  const double own = loop.K_d;
  double passes = 0.0, fails = own;
  for (double K_d = own; K_d > 1e-3 * own; K_d *= 0.9) {
    loop.K_d = K_d;
    if (Enough(MarginOf(loop), needed)) {
      passes = K_d;
      break;
    }
    fails = K_d;
  }
  for (int i = 0; i < 10 && passes > 0.0; ++i) {
    loop.K_d = 0.5 * (passes + fails);
    (Enough(MarginOf(loop), needed) ? passes : fails) = loop.K_d;
  }
  return passes;
}

}  // namespace reed
