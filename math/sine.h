// sin and cos, both at once, with the same bits on every machine: IEEE sums and products in the order written here, no table,
// no choice by processor. Largest error measured against 200 bits: 0.78 ulp (tests/elementary/test_accuracy.py). RT: safe.
#pragma once

#include <cmath>
#include <numbers>

#include "reed/math/exact.h"
#include "reed/math/pair.h"
#include "reed/math/round.h"

namespace reed::math {

template <typename T>
struct SineCosineOf {
  T sine, cosine;
};
using SineCosine = SineCosineOf<double>;

namespace internal {

/// Up to here x - n pi/2 is exact enough; n has 20 bits, each part of pi/2 but the last 33.
inline constexpr double kMostAngle = 0x1p20;

/// |r| <= pi/4 and a little: what is left of x after n quarters of a turn. Cody and Waite with what each subtraction loses carried
/// along. The minuend is the larger one, or the difference is exact: then both are below 2^-14 (2^-49) and multiples of 2^-66
/// (2^-101). So the short form of the exact sum is enough.
template <typename T>
constexpr ExactOf<T> LessQuarters(const T& x, const T& n) noexcept {
  constexpr double kHalfPi[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
  const ExactOf<T> a = SumOfOrdered<T>(x - n * T(kHalfPi[0]), -(n * T(kHalfPi[1])));
  const ExactOf<T> b = SumOfOrdered<T>(a.value, -(n * T(kHalfPi[2])));
  return {b.value, b.rest + (a.rest - n * T(kHalfPi[3]))};
}
inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

/// On |r| <= pi/4: r + r³ S(r²), minimax of degree 5.
template <typename T>
constexpr T SineOf(const ExactOf<T>& r) noexcept {
  const T z = r.value * r.value, z2 = z * z;
  const T S = (T(-0x1.5555555555548p-3) + z * T(0x1.111111110f7c4p-7)) +
              z2 * ((T(-0x1.a01a019bfc6cbp-13) + z * T(0x1.71de3566839ebp-19)) +
                    z2 * (T(-0x1.ae5e598a157e5p-26) + z * T(0x1.5d8f851aa4128p-33)));
  return r.value + ((z * r.value) * S + r.rest * (T(1.0) - T(0.5) * z));
}

/// On |r| <= pi/4: 1 - r²/2 + r⁴ C(r²), minimax of degree 5.
template <typename T>
constexpr T CosineOf(const ExactOf<T>& r) noexcept {
  const T z = r.value * r.value, z2 = z * z;
  const T C = (T(0x1.555555555554bp-5) + z * T(-0x1.6c16c16c14f8ap-10)) +
              z2 * ((T(0x1.a01a019c838ddp-16) + z * T(-0x1.27e4f7ea3586bp-22)) +
                    z2 * (T(0x1.1ee9d75141f4bp-29) + z * T(-0x1.8fa46549d5babp-37)));
  const T half = T(0.5) * z, w = T(1.0) - half;
  return w + (((T(1.0) - w) - half) + (z2 * C - r.value * r.rest));
}

inline double WithinRange(double x) noexcept {
  return std::abs(x) <= kMostAngle ? x : std::remainder(x, 2.0 * std::numbers::pi);  // exact
}

}  // namespace internal

/// x in rad. Beyond 2^20 rad the period is that of the double nearest to 2 pi. Not finite: NaN.
[[gnu::always_inline]] inline SineCosine SinCos(double x) noexcept {
  x = internal::WithinRange(x);
  const auto [n, quadrant] = NearestInteger(x * internal::kTwoOverPi);
  const Exact r = internal::LessQuarters(x, n);
  const double s = internal::SineOf(r), c = internal::CosineOf(r);
  const bool odd = (quadrant & 1) != 0;
  const double sine = odd ? c : s, cosine = odd ? s : c;
  return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

namespace internal {

template <typename P>
[[gnu::always_inline]] inline SineCosineOf<P> SinCosOfTwo(double first, double second) noexcept {
  if constexpr (P::kAtOnce) {
    const P x(WithinRange(first), WithinRange(second)), shifted = x * P(kTwoOverPi) + P(kIntegerShift);
    const ExactOf<P> r = LessQuarters<P>(x, shifted - P(kIntegerShift));
    const auto s = SineOf(r).bits(), c = CosineOf(r).bits(), quadrant = shifted.bits();
    const auto odd = -(quadrant & 1), sine = (odd & c) | (~odd & s), cosine = (odd & s) | (~odd & c);
    return {P::FromBits(sine ^ ((quadrant & 2) << 62)), P::FromBits(cosine ^ (((quadrant + 1) & 2) << 62))};
  } else {
    const SineCosine a = SinCos(first), b = SinCos(second);
    return {P(a.sine, b.sine), P(a.cosine, b.cosine)};
  }
}

}  // namespace internal

/// Of two angles at once, each as above.
[[gnu::always_inline]] inline SineCosineOf<Pair> SinCos(double first, double second) noexcept {
  return internal::SinCosOfTwo<Pair>(first, second);
}

inline double Sin(double x) noexcept { return SinCos(x).sine; }
inline double Cos(double x) noexcept { return SinCos(x).cosine; }

}  // namespace reed::math
