// sin and cos, both at once, with the same bits on every machine: IEEE sums and products in the order written here, no table,
// no choice by processor. Largest error measured against 200 bits: 0.78 ulp (tests/elementary/test_accuracy.py). RT: safe.
#pragma once

#include <cmath>
#include <numbers>

#include "reed/math/exact.h"
#include "reed/math/round.h"

namespace reed::math {

struct SineCosine {
  double sine, cosine;
};

namespace internal {

/// Up to here x - n pi/2 is exact enough; n has 20 bits, each part of pi/2 but the last 33.
inline constexpr double kMostAngle = 0x1p20;

struct Reduced {
  Exact r;  // |r| <= pi/4 and a little
  std::int64_t quadrant;
};

/// Cody and Waite with what each subtraction loses carried along. The minuend is the larger one, or the difference is exact: then
/// both are below 2^-14 (2^-49) and multiples of 2^-66 (2^-101). So the short form of the exact sum is enough.
constexpr Reduced ReduceAngle(double x) noexcept {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kHalfPi[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
  const Nearest n = NearestInteger(x * kTwoOverPi);
  const Exact a = SumOfOrdered(x - n.value * kHalfPi[0], -(n.value * kHalfPi[1]));
  const Exact b = SumOfOrdered(a.value, -(n.value * kHalfPi[2]));
  return {{b.value, b.rest + (a.rest - n.value * kHalfPi[3])}, n.integer};
}

/// On |r| <= pi/4: r + r³ S(r²), minimax of degree 5.
constexpr double SineOf(const Exact& r) noexcept {
  const double z = r.value * r.value, z2 = z * z;
  const double S = (-0x1.5555555555548p-3 + z * 0x1.111111110f7c4p-7) +
                   z2 * ((-0x1.a01a019bfc6cbp-13 + z * 0x1.71de3566839ebp-19) +
                         z2 * (-0x1.ae5e598a157e5p-26 + z * 0x1.5d8f851aa4128p-33));
  return r.value + ((z * r.value) * S + r.rest * (1.0 - 0.5 * z));
}

/// On |r| <= pi/4: 1 - r²/2 + r⁴ C(r²), minimax of degree 5.
constexpr double CosineOf(const Exact& r) noexcept {
  const double z = r.value * r.value, z2 = z * z;
  const double C = (0x1.555555555554bp-5 + z * -0x1.6c16c16c14f8ap-10) +
                   z2 * ((0x1.a01a019c838ddp-16 + z * -0x1.27e4f7ea3586bp-22) +
                         z2 * (0x1.1ee9d75141f4bp-29 + z * -0x1.8fa46549d5babp-37));
  const double half = 0.5 * z, w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z2 * C - r.value * r.rest));
}

}  // namespace internal

/// x in rad. Beyond 2^20 rad the period is that of the double nearest to 2 pi. Not finite: NaN.
[[gnu::always_inline]] inline SineCosine SinCos(double x) noexcept {
  if (!(std::abs(x) <= internal::kMostAngle)) x = std::remainder(x, 2.0 * std::numbers::pi);  // exact
  const internal::Reduced reduced = internal::ReduceAngle(x);
  const double s = internal::SineOf(reduced.r), c = internal::CosineOf(reduced.r);
  const bool odd = (reduced.quadrant & 1) != 0;
  const double sine = odd ? c : s, cosine = odd ? s : c;
  return {(reduced.quadrant & 2) != 0 ? -sine : sine, ((reduced.quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

inline double Sin(double x) noexcept { return SinCos(x).sine; }
inline double Cos(double x) noexcept { return SinCos(x).cosine; }

}  // namespace reed::math
