// Two numbers side by side: each operation is done on both as double does it, to the bit. One instruction for both where every
// processor of the kind has registers of two doubles. A scalar for Eigen's matrices, whose sums keep their order. RT: safe.
#pragma once

#include <bit>

namespace reed::math {

#if defined(__SSE2__) || defined(__aarch64__)
class Pair {
 public:
  static constexpr bool kAtOnce = true;

  Pair() = default;
  explicit Pair(double both) : at_{both, both} {}
  Pair(double first, double second) : at_{first, second} {}
  double first() const { return at_[0]; }
  double second() const { return at_[1]; }

  using Lanes = double __attribute__((vector_size(16)));
  using Bits = long long __attribute__((vector_size(16)));
  explicit Pair(const Lanes& at) : at_(at) {}
  static Pair FromBits(const Bits& bits) { return Pair(std::bit_cast<Lanes>(bits)); }
  Bits bits() const { return std::bit_cast<Bits>(at_); }

  Pair operator-() const { return Pair(-at_); }
  Pair& operator+=(const Pair& b) { return *this = *this + b; }
  Pair& operator-=(const Pair& b) { return *this = *this - b; }
  Pair& operator*=(const Pair& b) { return *this = *this * b; }
  friend Pair operator+(const Pair& a, const Pair& b) { return Pair(a.at_ + b.at_); }
  friend Pair operator-(const Pair& a, const Pair& b) { return Pair(a.at_ - b.at_); }
  friend Pair operator*(const Pair& a, const Pair& b) { return Pair(a.at_ * b.at_); }
  friend Pair operator/(const Pair& a, const Pair& b) { return Pair(a.at_ / b.at_); }

 private:
  Lanes at_;
};
#else
class Pair {
 public:
  static constexpr bool kAtOnce = false;

  Pair() = default;
  explicit Pair(double both) : first_(both), second_(both) {}
  Pair(double first, double second) : first_(first), second_(second) {}
  double first() const { return first_; }
  double second() const { return second_; }

  Pair operator-() const { return {-first_, -second_}; }
  Pair& operator+=(const Pair& b) { return *this = *this + b; }
  Pair& operator-=(const Pair& b) { return *this = *this - b; }
  Pair& operator*=(const Pair& b) { return *this = *this * b; }
  friend Pair operator+(const Pair& a, const Pair& b) { return {a.first_ + b.first_, a.second_ + b.second_}; }
  friend Pair operator-(const Pair& a, const Pair& b) { return {a.first_ - b.first_, a.second_ - b.second_}; }
  friend Pair operator*(const Pair& a, const Pair& b) { return {a.first_ * b.first_, a.second_ * b.second_}; }
  friend Pair operator/(const Pair& a, const Pair& b) { return {a.first_ / b.first_, a.second_ / b.second_}; }

 private:
  double first_, second_;
};
#endif

inline double SumOf(const Pair& pair) { return pair.first() + pair.second(); }
inline double SumOf(double alone) { return alone; }

}  // namespace reed::math
