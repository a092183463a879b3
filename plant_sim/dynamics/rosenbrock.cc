#include "reed/plant/dynamics/rosenbrock.h"

#include <numbers>

namespace reed::plant {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {
constexpr double kGamma = 1.0 - 0.5 * std::numbers::sqrt2;
}  // namespace

Rosenbrock::Rosenbrock(int size)
    : a1_(VectorXd::Zero(size)),
      a2_(VectorXd::Zero(size)),
      v1_(VectorXd::Zero(size)),
      v2_(VectorXd::Zero(size)),
      stage_x_(VectorXd::Zero(size)),
      stage_v_(VectorXd::Zero(size)) {
  implicit_.y_d = implicit_.y_k = VectorXd::Zero(size);
}

void Rosenbrock::Step(EquationsOfMotion& equations, const Load& begin, const Load& end, double h, VectorXd& x,
                      VectorXd& x_dot) {
  const double g = kGamma * h;
  implicit_.c_d = g;
  implicit_.c_k = g * g;

  // Stage 1: k1 = (v1, a1), v1 = x' + g a1.
  implicit_.y_d.setZero();
  implicit_.y_k = g * x_dot;
  implicit_.tool_y_d.setZero();
  implicit_.tool_y_k = g * equations.tool_velocity();
  equations.Solve(begin, implicit_, a1_);
  v1_ = x_dot + g * a1_;
  const Vector3d tool_a1 = equations.tool_rate();
  const Vector3d tool_v1 = equations.tool_velocity() + g * tool_a1;

  // Stage 2: κ = (v2, a2), v2 = x'_2 - 2 g a1 + g a2 at the state y + h k1.
  stage_x_ = x + h * v1_;
  stage_v_ = x_dot + h * a1_;
  equations.SetState(stage_x_, stage_v_);
  implicit_.y_d = 2.0 * g * a1_;
  implicit_.y_k = g * (stage_v_ - 2.0 * g * a1_) - 2.0 * g * v1_;
  implicit_.tool_y_d = 2.0 * g * tool_a1;
  implicit_.tool_y_k = g * (equations.tool_velocity() - 2.0 * g * tool_a1) - 2.0 * g * tool_v1;
  equations.Solve(end, implicit_, a2_);
  v2_ = stage_v_ - 2.0 * g * a1_ + g * a2_;

  x += 0.5 * h * (v1_ + v2_);
  x_dot += 0.5 * h * (a1_ + a2_);
  equations.SetState(x, x_dot);
}

}  // namespace reed::plant
