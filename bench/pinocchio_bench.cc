// The other side: what a user would put together from Pinocchio's C++ routines. The torque regressor alone,
// the regressor with separate reference velocity by polarisation, and a Slotine-Li step with the tool's
// Jacobian. It has no nodal compensation, no observer and no limits.
#include <cstring>
#include <pinocchio/algorithm/jacobian.hpp>

#include "reed/bench/chain.h"
#include "reed/bench/inputs.h"
#include "reed/bench/pinocchio_arm.h"
#include "reed/config/schema/arm_file.h"

namespace reed::bench {
namespace {

/// Γ(qd, v) = Γ(½(qd+v))² − Γ(½(qd−v))²: three regressors, of which the last takes gravity out of the second.
class PolarisedRegressor {
 public:
  explicit PolarisedRegressor(const ArmDescription& arm)
      : model_(PinocchioModel(arm)),
        data_(model_),
        map_(ParameterMap(arm).sparseView()),
        zero_(Eigen::VectorXd::Zero(arm.dof())),
        full_(arm.dof(), 10 * arm.dof()),
        Y_(arm.dof(), arm.num_parameters()) {}

  template <int N>
  const Eigen::MatrixXd& Y(const Input<N>& in) {
    sum_ = 0.5 * (in.qd + in.v);
    difference_ = 0.5 * (in.qd - in.v);
    q_ = in.q;
    a_ = in.v_dot;
    full_ = pinocchio::computeJointTorqueRegressor(model_, data_, q_, sum_, a_);
    full_ -= pinocchio::computeJointTorqueRegressor(model_, data_, q_, difference_, zero_);
    full_ += pinocchio::computeJointTorqueRegressor(model_, data_, q_, zero_, zero_);
    Y_.noalias() = full_ * map_;
    return Y_;
  }

  template <int N>
  const Eigen::MatrixXd& TorqueRegressor(const Input<N>& in) {
    q_ = in.q;
    sum_ = in.qd;
    a_ = in.v_dot;
    return pinocchio::computeJointTorqueRegressor(model_, data_, q_, sum_, a_);
  }

  pinocchio::Model model_;
  pinocchio::Data data_;

 private:
  Eigen::SparseMatrix<double> map_;
  Eigen::VectorXd zero_, sum_, difference_, q_, a_;
  Eigen::MatrixXd full_, Y_;
};

/// tau = J_m v̇ + Y p̂ − Jᵀ F_d + K_d s,  p̂' = Γ Yᵀ s.
class SlotineLi {
 public:
  explicit SlotineLi(const ArmDescription& arm)
      : regressor_(arm),
        p_hat_(Eigen::VectorXd::Constant(arm.num_parameters(), 0.3)),
        J_(Eigen::MatrixXd::Zero(6, arm.dof())),
        J_m_(Eigen::Map<const Eigen::VectorXd>(arm.rotor_inertia_kgm2.data(), arm.dof())) {}

  template <int N>
  const Eigen::VectorXd& Run(const Input<N>& in) {
    q_ = in.q;
    const Eigen::MatrixXd& Y = regressor_.Y(in);
    pinocchio::computeJointJacobian(regressor_.model_, regressor_.data_, q_,
                                    static_cast<pinocchio::JointIndex>(N), J_);
    s_ = in.v - in.qd;
    tau_ = J_m_.cwiseProduct(in.v_dot);
    tau_.noalias() += Y * p_hat_;
    tau_.noalias() -= J_.topRows<3>().transpose() * force_;
    tau_ += 20.0 * s_;
    p_hat_.noalias() += 1e-6 * (Y.transpose() * s_);
    return tau_;
  }

 private:
  PolarisedRegressor regressor_;
  Eigen::VectorXd p_hat_, q_, s_, tau_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd J_m_;
  Eigen::Vector3d force_{0.0, 0.0, 10.0};
};

template <int N>
void Run(const Stopwatch& watch, const char* arm_name) {
  const ArmDescription arm = LoadArm(arm_name);
  const Inputs<N> inputs;
  const std::string suffix = std::string("_") + arm_name;
  PolarisedRegressor regressor(arm);
  watch.Measure("torque_regressor" + suffix, [&](int k) { Keep(regressor.TorqueRegressor(inputs[k])); });
  watch.Measure("polarised" + suffix, [&](int k) { Keep(regressor.Y(inputs[k])); });
  SlotineLi law(arm);
  watch.Measure("step" + suffix, [&](int k) { Keep(law.Run(inputs[k])); });
}

template <int N>
void Grow(const Stopwatch& watch) {
  const Inputs<N> inputs;
  SlotineLi law(Chain(N));
  watch.Measure("step_" + std::to_string(N), [&](int k) { Keep(law.Run(inputs[k])); });
}

/// Both programs' Y of the first input: the comparison is of the same thing, or it is worth nothing.
void PrintY() {
  PolarisedRegressor regressor(LoadArm("a5"));
  const Eigen::MatrixXd& Y = regressor.Y(Inputs<5>()[0]);
  for (Eigen::Index i = 0; i < Y.size(); ++i) std::printf("%.17g\n", Y.data()[i]);
}

}  // namespace
}  // namespace reed::bench

int main(int argc, char** argv) {
  using namespace reed::bench;  // NOLINT(google-build-using-namespace): one list of calls
  if (argc > 1 && std::strcmp(argv[1], "--print-y") == 0) {
    PrintY();
    return 0;
  }
  const Stopwatch watch(argc, argv);
  Run<5>(watch, "a5");
  Run<7>(watch, "a7");
  Grow<2>(watch);
  Grow<4>(watch);
  Grow<8>(watch);
  Grow<16>(watch);
  Grow<32>(watch);
}
