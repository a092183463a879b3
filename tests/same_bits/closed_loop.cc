// Controller and simulated arm in one loop, without bus, files and telemetry: few sources, so that a test can build it with any
// compiler for any processor. Prints the digest of every state and torque (FNV-1a over their 64 bits) and the last of them.
#include <bit>
#include <cstdio>
#include <cstdlib>

#include "reed/config/schema/halves.h"
#include "reed/firmware/controller/for_joints.h"
#include "reed/plant/endpoint/flexible_arm_body.h"
#include "reed/plant/endpoint/robot.h"
#include "reed/tests/support/arms.h"

REED_CONTROLLER_FOR(extern, 5)
REED_SET_UP_FOR(extern, 5)

namespace reed {
namespace {

constexpr int N = 5, P = 7;

/// The scenario press_known with a disturbance, without its file.
Scenario PressKnown() {
  Scenario s;
  s.name = "press_known";
  s.seed = 77;
  s.arm = test::ArmA5();
  for (const double torque : s.arm.coulomb_Nm) s.arm.coulomb_declared_Nm.push_back(torque);
  s.arm.position_min_rad = {-2.9, -1.9, -2.8, -2.6, -3.0};
  s.arm.position_max_rad = {2.9, 1.9, 2.8, 2.6, 3.0};
  s.arm.speed_limit_radps = {3.0, 3.0, 3.5, 4.0, 5.0};
  s.reference.start_rad = {0.0, 1.057362, -1.764384, -2.43457, 0.0};
  ReferenceLeg down, slide;
  down.kind = ReferenceLeg::Kind::kCartesian;
  down.duration_s = 0.4;
  down.by_m = {0.0, 0.0, -0.004};
  slide.kind = ReferenceLeg::Kind::kSlide;
  slide.duration_s = 60.0;
  slide.amplitude_m = {0.02, 0.02, 0.0};
  slide.frequency_hz = 0.5;
  s.reference.legs = {down, slide};
  s.wall.present = true;
  s.wall.point_m = {0.4, 0.0, 0.156};
  s.wall.offset_m = -0.001;
  s.disturbance.amplitude_N = {0.2, 0.1, 0.1};
  s.disturbance.frequencies_hz = {3.0, 11.0};
  s.force.source = ForceConfig::Source::kKnown;
  s.force.desired_N = 8.0;
  s.force.start_s = 0.3;
  s.force.ramp_s = 0.5;
  s.control.K_d = {33.0, 30.0, 18.0, 5.5, 3.1};
  s.control.Lambda = {15.0, 15.0, 15.0, 15.0, 15.0};
  return s;
}

class Digest {
 public:
  void Take(double value) {
    last_ = value;
    for (auto bits = std::bit_cast<std::uint64_t>(value), i = std::uint64_t{0}; i < 8; ++i, bits >>= 8U)
      hash_ = (hash_ ^ (bits & 0xFFU)) * 0x100000001B3U;
  }
  template <typename Values>
  void TakeAll(const Values& values) {
    for (const double value : values) Take(value);
  }
  std::uint64_t hash() const { return hash_; }
  double last() const { return last_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325U;
  double last_ = 0.0;
};

struct NoRecord final : plant::RecordSink {
  void Put(const plant::Record&) noexcept override {}
};

Measurement<N> FromDrives(const plant::Measurement& sensed) {
  Measurement<N> m;
  for (std::size_t i = 0; i < N; ++i) {
    const bus::JointStateMessage& joint = sensed.joints[i];
    const auto row = static_cast<Eigen::Index>(i);
    m.theta[row] = joint.position_rad;
    m.theta_dot[row] = joint.velocity_radps;
    m.torque[row] = joint.torque_Nm;
    m.drive[i] = static_cast<DriveState>(joint.state);
  }
  m.force = sensed.wrench.force_N;
  m.moment = sensed.wrench.moment_Nm;
  m.wrench_age = sensed.wrench_lost ? Measurement<N>::kNever : 0;
  return m;
}

int Run(int cycles) {
  const Scenario scenario = PressKnown();
  const PlantConfig truth = PlantHalf(scenario);
  NoRecord nowhere;
  plant::Journal journal(nowhere);
  plant::FlexibleArmBody body(truth);
  plant::Robot robot(truth, body, journal);
  const Settings<N, P> settings = SettingsFrom<N, P>(ControllerHalf(scenario), true);
  const reference::PlannedPath<N> path = PathFrom(ControllerHalf(scenario), settings.arm);
  Controller<N, P> controller(settings, path.View());
  Digest digest;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    CycleState state;
    state.all_answered = true;
    const Command<N>& command = controller.Step(FromDrives(robot.Measure()), state);
    bus::CommandMessage message{0, static_cast<bus::DriveRequest>(command.request), {}};
    for (int i = 0; i < N; ++i) message.torque_Nm[static_cast<std::size_t>(i)] = command.torque[i];
    robot.Command(message);
    robot.Advance(settings.period_s());
    digest.TakeAll(command.torque);
    digest.TakeAll(body.truth().motor_angle_rad);
    digest.TakeAll(body.truth().motor_speed_radps);
    digest.TakeAll(body.truth().tip_m);
    digest.Take(body.truth().normal_force_N);
  }
  std::printf("%016llx mode %d force %.17g\n", static_cast<unsigned long long>(digest.hash()),
              static_cast<int>(controller.mode()), digest.last());
  return 0;
}

}  // namespace
}  // namespace reed

int main(int argc, char** argv) { return reed::Run(argc > 1 ? std::atoi(argv[1]) : 1000); }
