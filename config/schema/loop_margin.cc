#include "reed/config/schema/loop_margin.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace reed {
namespace {

constexpr double kDamping = 0.01;          // of the motor-spring mode, of critical: less than any gearbox has
constexpr double kLeastInertia = 1e-4;     // of the rotor's: a link on its own axis has none
constexpr double kLargestGainMargin = 64;  // more is not told apart
constexpr int kStates = 7;  // θ θ̇ q q̇, ω, θ of the last sample, torque until the next one

// Of dynamic size: seven unrolled rows took 25 s to compile, and this runs once, at start.
using Eigen::MatrixXd;
using Complex = std::complex<double>;

double LinkInertia(const JointLoop& loop) {
  return std::max(loop.inertia_kgm2, kLeastInertia * loop.rotor_inertia_kgm2);
}

/// Of the difference quotient in the low pass of one period.
double FilterShare(const JointLoop& loop) {
  return -std::expm1(-2.0 * std::numbers::pi * loop.velocity_filter_hz * loop.period_s);
}

/// N·m·s/rad
double VelocityGain(const JointLoop& loop) {
  const double total = LinkInertia(loop) + loop.rotor_inertia_kgm2;
  return loop.K_d + (loop.acceleration ? total * loop.Lambda : 0.0);
}

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
  const double J = loop.rotor_inertia_kgm2, M = LinkInertia(loop);
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
  const double share = FilterShare(loop);
  F.row(4) << share / T, 0.0, 0.0, 0.0, 1.0 - share, -share / T, 0.0;
  F(5, 0) = 1.0;
  F.row(6) = -VelocityGain(loop) * F.row(4);
  F(6, 0) -= loop.K_d * loop.Lambda;
  return F;
}

bool Stable(MatrixXd F, double gain) {
  F.row(6) *= gain;
  // F^(2^k): it vanishes or grows without bound. 2^24 periods tell a radius of 1 - 1e-6 from 1.
  for (int k = 0; k < 24; ++k) {
    F = F.lazyProduct(F).eval();  // the kernel for large matrices costs four times this
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

/// Without the checks for infinite parts that the operator makes, a third of the time of a phase margin.
Complex Quotient(Complex a, Complex b) { return a * std::conj(b) / std::norm(b); }

/// θ over the torque held through a period: rotor and link moving as one, and against each other on the spring.
class MotorAngle {
 public:
  MotorAngle(double J, double M, double k, double T)
      : rigid_(T * T / (2.0 * (J + M))), bending_(M / ((J + M) * J)) {
    const double w_0 = std::sqrt(k * (1.0 / J + 1.0 / M)), w_d = w_0 * std::sqrt(1.0 - kDamping * kDamping);
    const double decay = std::exp(-kDamping * w_0 * T);
    const double c = decay * std::cos(w_d * T), s = decay * std::sin(w_d * T) * kDamping * w_0 / w_d;
    a_1_ = -2.0 * c;
    a_2_ = decay * decay;
    b_1_ = (1.0 - c - s) / (w_0 * w_0);
    b_2_ = (a_2_ - c + s) / (w_0 * w_0);
  }

  Complex operator()(Complex z) const {
    return Quotient(rigid_ * (z + 1.0), (z - 1.0) * (z - 1.0)) +
           Quotient(bending_ * (b_1_ * z + b_2_), (z + a_1_) * z + a_2_);
  }

 private:
  double rigid_, bending_, a_1_, a_2_, b_1_, b_2_;
};

/// From the torque that the law asks for to what it asks next, in closed form: solving z − F at each point was a third of the
/// whole time of a run in one process.
class OpenLoop {
 public:
  explicit OpenLoop(const JointLoop& loop)
      : angle_(loop.rotor_inertia_kgm2, LinkInertia(loop), loop.stiffness_Nmprad, loop.period_s),
        T_(loop.period_s),
        share_(FilterShare(loop)),
        velocity_gain_(VelocityGain(loop)),
        position_gain_(loop.K_d * loop.Lambda) {}

  Complex operator()(double w) const {
    const Complex z = std::polar(1.0, w * T_);
    const Complex speed = Quotient(share_ / T_ * (z - 1.0), z - 1.0 + share_);
    return (velocity_gain_ * speed + position_gain_) * angle_(z) * std::conj(z);  // 1/z
  }
  bool Amplifies(double w) const { return std::norm((*this)(w)) > 1.0; }

 private:
  MotorAngle angle_;
  double T_, share_, velocity_gain_, position_gain_;
};

/// Least angle between the open loop and -1 wherever it has the size of 1.
double PhaseMargin(const JointLoop& loop) {
  constexpr int kPoints = 2000;
  constexpr int kHalvings = 30;  // beside a resonance the angle turns by 7° from point to point
  const OpenLoop L(loop);
  const double highest = std::numbers::pi / loop.period_s, lowest = 0.1;
  const double ratio = std::pow(highest / lowest, 1.0 / (kPoints - 1));
  double least = std::numbers::pi, below = lowest;
  bool amplified = L.Amplifies(below);
  for (int i = 1; i < kPoints; ++i) {
    const double next = below * ratio;
    const bool amplified_before = std::exchange(amplified, L.Amplifies(next));
    if (amplified != amplified_before) {
      double above = next;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (below + above);
        (L.Amplifies(middle) == amplified_before ? below : above) = middle;
      }
      least = std::min(least, std::abs(std::arg(-L(below))));
    }
    below = next;
  }
  return least * 180.0 / std::numbers::pi;
}

}  // namespace

LoopMargin MarginOf(const JointLoop& loop) {
  const double gain = GainMargin(PeriodOf(loop));
  return {gain, gain < 1.0 ? 0.0 : PhaseMargin(loop)};
}

bool Enough(const LoopMargin& margin, const LoopMargin& needed) {
  return margin.gain >= needed.gain && margin.phase_deg >= needed.phase_deg;
}

double LargestKd(JointLoop loop, const LoopMargin& needed) {
  double passes = 0.0, fails = loop.K_d;
  // Down to 0.9^66 < 0.001 of it. Counted: the least numbers times 0.9 are themselves, rounded.
  constexpr int kSteps = 66;
  for (int i = 0; i < kSteps && passes == 0.0; ++i) {
    if (Enough(MarginOf(loop), needed)) {
      passes = loop.K_d;
    } else {
      fails = loop.K_d;
      loop.K_d *= 0.9;
    }
  }
  for (int i = 0; i < 10 && passes > 0.0; ++i) {
    loop.K_d = 0.5 * (passes + fails);
    (Enough(MarginOf(loop), needed) ? passes : fails) = loop.K_d;
  }
  return passes;
}

}  // namespace reed
