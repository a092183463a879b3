// The angle and the length of a vector of the plane with the same bits on every machine. Largest errors measured against 200
// bits, in ulp (tests/elementary/test_accuracy.py): Atan2 0.64, Length 0.50. Not for the loop's hottest places: each divides twice. RT: safe.
#pragma once

#include <cmath>

#include "reed/math/exact.h"

namespace reed::math {
namespace internal {

/// Arc tangent of (y + 0) / (x + 0), 0 <= y <= x, x > 0.
constexpr Exact ArcOfOctant(double y, double x) noexcept {
  constexpr Exact kArc[] = {{0.0, 0.0},
                            {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                            {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
  constexpr double kTangent[] = {0.0, 0.5, 1.0};
  const int at = y < 0.4375 * x ? 0 : y < 0.6875 * x ? 1 : 2;
  const double t = kTangent[at];  // tan(a - b) = (tan a - t) / (1 + t tan a); t times a number is exact
  const Exact u = Quotient(Sum(y, -(t * x)), Sum(x, t * y));
  // u + u³ A(u²) on |u| <= 0.4375, minimax of degree 10.
  const double z = u.value * u.value, z2 = z * z, z4 = z2 * z2;
  const double A =
      ((-0x1.5555555555509p-2 + z * 0x1.999999998e493p-3) +
       z2 * (-0x1.2492491fdfcf9p-3 + z * 0x1.c71c6fd410203p-4)) +
      z4 * (((-0x1.745cdae92e8ebp-4 + z * 0x1.3b0f145c08878p-4) +
             z2 * (-0x1.10d58418e4b2fp-4 + z * 0x1.ddd7226b3c25ap-5)) +
            z4 * ((-0x1.97858527a3c86p-5 + z * 0x1.2ad8f8b237ce9p-5) + z2 * -0x1.0a014f4ccf0e3p-6));
  const double beyond = (z * u.value) * A + u.rest / (1.0 + z);
  const Exact sum = Sum(kArc[at].value, u.value);
  return SumOfOrdered(sum.value, sum.rest + (kArc[at].rest + beyond));
}

/// corner - arc, of which corner is pi or pi/2.
constexpr Exact Beyond(const Exact& corner, const Exact& arc) noexcept {
  const Exact sum = Sum(corner.value, -arc.value);
  return SumOfOrdered(sum.value, sum.rest + (corner.rest - arc.rest));
}

}  // namespace internal

/// In [-pi, pi], of the vector (x, y); of (0, 0) zero. Pre: both between 1e-140 and 1e140 in size, or zero.
inline double Atan2(double y, double x) noexcept {
  constexpr Exact kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
      kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  const double ax = std::abs(x), ay = std::abs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  Exact arc =
      ay <= ax ? internal::ArcOfOctant(ay, ax) : internal::Beyond(kHalfPi, internal::ArcOfOctant(ax, ay));
  if (x < 0.0) arc = internal::Beyond(kPi, arc);
  return std::copysign(arc.value, y);
}

/// √(x² + y²). Pre: as of Atan2.
inline double Length(double x, double y) noexcept {
  const Exact xx = Product(x, x), yy = Product(y, y), sum = Sum(xx.value, yy.value);
  if (!(sum.value > 0.0)) return sum.value;
  const double root = std::sqrt(sum.value);
  const Exact back = Product(root, root);
  return root + ((sum.value - back.value) - back.rest + (sum.rest + (xx.rest + yy.rest))) / (2.0 * root);
}

}  // namespace reed::math
