// Sums and products of two numbers together with what rounding took from them: value + rest is exact (Knuth, Dekker).
// Pre: nothing overflows, and of a product nothing underflows. RT: safe.
#pragma once

namespace reed::math {

template <typename T>
struct ExactOf {
  T value, rest;
};
using Exact = ExactOf<double>;

constexpr Exact Sum(double a, double b) noexcept {
  const double s = a + b, b_in_s = s - a;
  return {s, (a - (s - b_in_s)) + (b - b_in_s)};
}

/// Pre: |a| >= |b|.
template <typename T>
constexpr ExactOf<T> SumOfOrdered(const T& a, const T& b) noexcept {
  const T s = a + b;
  return {s, b - (s - a)};
}

/// The upper 26 bits and the rest.
constexpr Exact Halves(double a) noexcept {
  const double scaled = 0x8000001p0 * a, upper = scaled - (scaled - a);
  return {upper, a - upper};
}

constexpr Exact Product(double a, double b) noexcept {
  const double p = a * b;
  const Exact x = Halves(a), y = Halves(b);
  return {p, ((x.value * y.value - p) + x.value * y.rest + x.rest * y.value) + x.rest * y.rest};
}

/// (n + n_rest) / (d + d_rest).
constexpr Exact Quotient(const Exact& n, const Exact& d) noexcept {
  const double q = n.value / d.value;
  const Exact back = Product(q, d.value);
  return {q, (((n.value - back.value) - back.rest) + (n.rest - q * d.rest)) / d.value};
}

}  // namespace reed::math
