// The controller without files, frames and clock: two joints, settings written here, one step per period.
#include <reed/core/controller.h>

#include <cstdio>

namespace {

constexpr int N = 2, P = 1;
using Knot = reed::reference::JointPath<N>::Knot;
using Vec = reed::model::Vec<N>;

/// Two links of 1 m with a point mass of 1 kg at the end of each, moving in the vertical plane.
reed::Settings<N, P> TwoLinks() {
  reed::Settings<N, P> s;
  s.arm = {};
  s.arm.mount_R[0] << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;  // the first axis is horizontal
  s.arm.mount_R[1].setIdentity();
  s.arm.mount_p[0].setZero();
  s.arm.mount_p[1] = Eigen::Vector3d::UnitX();
  s.arm.d.setZero();
  s.arm.gravity << 0.0, 0.0, -9.81;
  s.arm.tool_offset << 1.0, 0.0, 0.0;
  s.arm.tool_rotation.setIdentity();
  s.arm.sensor_rotation.setIdentity();
  s.arm.sensor_to_tool.setZero();
  s.arm.sensor_tool_mass = 0.0;
  s.arm.sensor_tool_com.setZero();
  const reed::model::MassMoments end(1.0, Eigen::Vector3d::UnitX(), Eigen::Matrix3d::Zero());
  for (int i = 0; i < N; ++i) {
    s.arm.first_shape[i] = i;
    s.arm.shape[i] = {P, end};  // k = P: known
    s.arm.carrier[i] = -1;
  }
  s.arm.first_shape[N] = N;
  s.arm.viscous.setZero();
  s.arm.p_nominal.setZero();
  s.arm.p_lo.setZero();
  s.arm.p_hi.setZero();
  s.arm.num_parameters = 0;
  s.arm.num_members = 0;
  s.arm.rotor_inertia = Vec::Constant(0.1);
  s.arm.joint_stiffness = Vec::Constant(1e9);
  s.arm.joint_hardening.setZero();
  s.arm.torque_limit = Vec::Constant(100.0);
  s.arm.position_max = Vec::Constant(3.0);
  s.arm.position_min = -s.arm.position_max;
  s.arm.speed_limit = Vec::Constant(3.0);
  s.gains = {};
  s.gains.K_d = Vec::Constant(20.0);
  s.gains.Lambda = Vec::Constant(10.0);
  s.gains.sliding.phi = 0.03;
  s.gains.K_o = 80.0;
  s.gains.friction_speed = 0.01;
  s.law = reed::strategy::LawId::kFixedNominal;
  s.limits = {s.arm.torque_limit,
              Vec::Constant(20.0),
              s.arm.position_min,
              s.arm.position_max,
              s.arm.speed_limit,
              60.0,
              2,
              10};
  s.duration_s = 1.0;
  s.start_wanted = true;
  return s;
}

}  // namespace

int main() {
  const reed::Settings<N, P> settings = TwoLinks();
  const Knot knots[2] = {{Vec::Zero(), Vec::Zero(), Vec::Zero()}, {Vec::Zero(), Vec::Zero(), Vec::Zero()}};
  reed::Controller<N, P> controller(settings, {knots, 1.0});

  reed::Measurement<N> measured;  // still, stretched out, every joint fresh, no force sensor
  measured.age.fill(0);
  measured.wrench_age = reed::Measurement<N>::kNever;
  measured.drive.fill(reed::DriveState::kReady);
  reed::CycleState state;
  state.all_answered = true;
  while (controller.mode() != reed::mode::Mode::kActive) {
    if (controller.Step(measured, state).request == reed::DriveRequest::kEnable)
      measured.drive.fill(reed::DriveState::kEnabled);
  }
  const reed::Command<N>& command = controller.Step(measured, state);
  // Held against gravity: g (1 + 2) and g · 1 · 1 m about the two horizontal axes.
  std::printf("torque %.3f %.3f N·m\n", command.torque[0], command.torque[1]);
  return 0;
}
