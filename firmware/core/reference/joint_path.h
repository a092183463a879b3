// The planned joint motion as a table of knots (owned by whoever planned it) with quintic Hermite interpolation between them: C², no
// search, no surprise. Filled at set-up (path_planner.h); evaluation RT: safe.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "reed/core/law/surface.h"

namespace reed::reference {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;

template <int N>
class JointPath {
 public:
  struct Knot {
    Vec<N> q, q_dot, q_ddot;
  };

  /// Knots at 0, h, 2h, …; at least two. They outlive the path.
  JointPath(std::span<const Knot> knots, double h_s) noexcept : knots_(knots), h_(h_s) {}

  double duration_s() const noexcept { return h_ * static_cast<double>(knots_.size() - 1); }
  std::span<const Knot> knots() const noexcept { return knots_; }

  /// At time t; before the start and after the end the arm rests at the first and last knot.
  control::Reference<N> At(double t_s) const noexcept {
    control::Reference<N> out;
    const double x = t_s / h_;
    if (!(x > 0.0)) {
      out.theta_d = knots_.front().q;
      return out;
    }
    const std::size_t last = knots_.size() - 1;
    if (x >= static_cast<double>(last)) {
      out.theta_d = knots_.back().q;
      return out;
    }
    const std::size_t k = static_cast<std::size_t>(x);
    Interpolate(knots_[k], knots_[k + 1], x - static_cast<double>(k), out);
    return out;
  }

 private:
  /// Quintic with value, speed and acceleration of both knots; u in [0, 1).
  void Interpolate(const Knot& a, const Knot& b, double u, control::Reference<N>& out) const noexcept {
    const Vec<N> v0 = h_ * a.q_dot, v1 = h_ * b.q_dot;
    const Vec<N> w0 = 0.5 * h_ * h_ * a.q_ddot, w1 = 0.5 * h_ * h_ * b.q_ddot;
    const Vec<N> d = b.q - a.q - v0 - w0;  // what cubic to quintic must still do to the value,
    const Vec<N> d1 = v1 - v0 - 2.0 * w0;  // to the slope,
    const Vec<N> d2 = w1 - w0;             // and to half the curvature, at u = 1
    const Vec<N> c3 = 10.0 * d - 4.0 * d1 + d2;
    const Vec<N> c4 = -15.0 * d + 7.0 * d1 - 2.0 * d2;
    const Vec<N> c5 = 6.0 * d - 3.0 * d1 + d2;
    out.theta_d = a.q + u * (v0 + u * (w0 + u * (c3 + u * (c4 + u * c5))));
    out.theta_d_dot = (v0 + u * (2.0 * w0 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / h_;
    out.theta_d_ddot = (2.0 * w0 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (h_ * h_);
  }

  std::span<const Knot> knots_;
  double h_;
};

}  // namespace reed::reference
