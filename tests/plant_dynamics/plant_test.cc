// What the loop relies on: repeatable, off the heap, honest about a state that went wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reed/tests/plant_dynamics/bench.h"
#include "reed/tests/support/no_alloc.h"

namespace reed::plant {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

PlantConfig Pressing() {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  scene.wall.present = true;
  scene.disturbance.amplitude_N = {0.2, 0.1, 0.3};
  scene.disturbance.frequencies_hz = {3.0, 17.0};
  scene.plant.payload_step_kg = 0.2;
  scene.plant.payload_step_s = 0.05;
  ArmPlant probe(scene);
  probe.Reset(test::MidPose());
  scene.wall.point_m = probe.truth().tip_m;
  return scene;
}

VectorXd Torque(int i) { return VectorXd::LinSpaced(5, 3.0, -1.0) * std::sin(0.05 * i); }

TEST(ArmPlant, EqualRunsAreEqualBitForBit) {
  ArmPlant a(Pressing()), b(Pressing()), c(Pressing());
  a.Reset(test::MidPose());
  for (int i = 0; i < 50; ++i) b.Advance(Torque(i), false, 1e-3);  // a past does not matter
  b.Reset(test::MidPose());
  c.Reset(test::MidPose());
  c.StartSchedule();
  c.Reset(test::MidPose());  // nor that it was at rest here already,
  c.Reset(test::MidPose());  // once or more often
  a.StartSchedule();
  b.StartSchedule();
  c.StartSchedule();
  for (int i = 0; i < 300; ++i) {
    a.Advance(Torque(i), i > 250, 1e-3);
    b.Advance(Torque(i), i > 250, 1e-3);
    c.Advance(Torque(i), i > 250, 1e-3);
    for (const ArmPlant* other : {&b, &c}) {
      ASSERT_EQ(a.truth().motor_angle_rad, other->truth().motor_angle_rad) << i;
      ASSERT_EQ(a.truth().tip_velocity_mps, other->truth().tip_velocity_mps) << i;
      ASSERT_EQ(a.truth().contact_force_N, other->truth().contact_force_N) << i;
    }
  }
}

TEST(ArmPlant, AdvanceStaysOffTheHeap) {
  ArmPlant plant(Pressing());
  plant.Reset(test::MidPose());
  plant.StartSchedule();
  const VectorXd torque = Torque(30);
  const test::NoAlloc guard("ArmPlant::Advance");
  for (int i = 0; i < 100; ++i) plant.Advance(torque, i > 60, 1e-3);
}

TEST(ArmPlant, ShapeIsTheTruthAndStraightWithoutBending) {
  PlantConfig scene = Pressing();
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  const ArmShape& sagging = plant.Shape();
  ASSERT_EQ(sagging.bent.size(), sagging.rigid.size());
  EXPECT_EQ(sagging.bent.front(), Vector3d::Zero());
  EXPECT_LT((sagging.bent.back() - plant.truth().tip_m).norm(), 1e-15);
  const double sag_m = (sagging.bent.back() - sagging.rigid.back()).norm();
  EXPECT_GT(sag_m, 1e-4);
  EXPECT_LT(sag_m, 2e-2);

  scene.arm.gravity_mps2.setZero();
  ArmPlant weightless(scene);
  weightless.Reset(test::MidPose());
  const ArmShape& straight = weightless.Shape();
  for (std::size_t k = 0; k < straight.bent.size(); ++k) {
    EXPECT_LT((straight.bent[k] - sagging.rigid[k]).norm(), 1e-9) << k;
  }
}

TEST(ArmPlant, ShapeStaysOffTheHeap) {
  ArmPlant plant(Pressing());
  plant.Reset(test::MidPose());
  const test::NoAlloc guard("ArmPlant::Shape");
  for (int i = 0; i < 10; ++i) plant.Shape();
}

TEST(ArmPlant, SmallerStepsConvergeWithTheSquareOfTheStep) {
  const auto end = [](double step) {
    PlantConfig scene = test::LosslessA5();
    scene.plant.damping_ratio = 0.02;
    scene.plant.max_step_s = step;
    ArmPlant plant(scene);
    plant.Reset(test::MidPose());
    for (int i = 0; i < 200; ++i) plant.Advance(Torque(i), false, 1e-3);
    return Vector3d(plant.truth().tip_m);
  };
  const Vector3d exact = end(10e-6);
  const double coarse = (end(200e-6) - exact).norm(), fine = (end(100e-6) - exact).norm();
  EXPECT_LT(coarse, 1e-5);
  EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

TEST(ArmPlant, StepsAreNoLongerThanAllowedAndFillTheTime) {
  PlantConfig scene = Pressing();
  scene.plant.max_step_s = 0.3e-3;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  for (int i = 0; i < 7; ++i) plant.Advance(Torque(0), false, 1e-3);
  EXPECT_NEAR(plant.truth().t_s, 7e-3, 1e-15);
}

TEST(ArmPlant, PayloadComesWhenItShallAndWeighsWhatItShall) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  scene.plant.damping_ratio = 0.05;
  scene.plant.payload_step_kg = 1.0;
  scene.plant.payload_step_s = 0.1;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  for (int i = 0; i < 150; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  plant.StartSchedule();
  const double before = plant.truth().potential_J, height = plant.truth().tip_m.z();
  for (int i = 0; i < 99; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  EXPECT_NEAR(plant.truth().potential_J, before, 0.05);
  for (int i = 0; i < 2000; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  EXPECT_NEAR(plant.truth().potential_J, before + 9.81 * height, 0.05);
  EXPECT_LT(plant.truth().tip_m.z(), height - 5e-4);
}

TEST(ArmPlant, StateThatIsNoNumberIsNamedWithItsTime) {
  ArmPlant plant(Pressing());
  plant.Reset(test::MidPose());
  plant.Advance(VectorXd::Zero(5), false, 1e-3);
  EXPECT_TRUE(plant.healthy());
  EXPECT_EQ(plant.fault_description(), "");
  VectorXd torque = VectorXd::Zero(5);
  torque[2] = std::numeric_limits<double>::quiet_NaN();
  plant.Advance(torque, false, 1e-3);
  EXPECT_FALSE(plant.healthy());
  EXPECT_NE(plant.fault_description().find("motor"), std::string::npos) << plant.fault_description();
  EXPECT_NE(plant.fault_description().find("t = 0.002 s"), std::string::npos) << plant.fault_description();
  plant.Reset(test::MidPose());
  EXPECT_TRUE(plant.healthy());
}

TEST(ArmPlant, AbsurdSpeedIsNamedWithItsJoint) {
  ArmPlant plant(Pressing());
  plant.Reset(test::MidPose());
  VectorXd torque = VectorXd::Zero(5);
  torque[4] = 1e6;
  for (int i = 0; i < 10; ++i) plant.Advance(torque, false, 1e-3);
  EXPECT_FALSE(plant.healthy());
  EXPECT_NE(plant.fault_description().find("motor 5"), std::string::npos) << plant.fault_description();
}

class RefusedArmTest : public testing::TestWithParam<std::pair<const char*, void (*)(PlantConfig&)>> {};

TEST_P(RefusedArmTest, SaysWhatIsMissing) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  GetParam().second(scene);
  try {
    ArmPlant plant(scene);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().first), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Arms, RefusedArmTest,
    testing::Values(
        std::pair(
            "rotor inertia of every joint", +[](PlantConfig& s) { s.arm.rotor_inertia_kgm2.clear(); }),
        std::pair(
            "rotor inertia of joint 2", +[](PlantConfig& s) { s.arm.rotor_inertia_kgm2[1] = 0.0; }),
        std::pair(
            "stiffness of joint 3", +[](PlantConfig& s) { s.arm.joint_stiffness_Nmprad[2] = -1.0; }),
        std::pair(
            "section 4 is needed", +[](PlantConfig& s) { s.arm.sections.pop_back(); }),
        std::pair(
            "5 sections are given for 4",
            +[](PlantConfig& s) { s.arm.sections.push_back(s.arm.sections[0]); }),
        std::pair(
            "section 2 has length", +[](PlantConfig& s) { s.arm.sections[1].length_m = 0.3; }),
        std::pair(
            "member 3 needs positive", +[](PlantConfig& s) { s.arm.sections[2].EI_Nm2 = 0.0; }),
        std::pair(
            "one body per link", +[](PlantConfig& s) { s.arm.bodies.pop_back(); }),
        std::pair(
            "max_step_s", +[](PlantConfig& s) { s.plant.max_step_s = 0.0; }),
        std::pair(
            "elements_per_link", +[](PlantConfig& s) { s.plant.elements_per_link = 0; }),
        std::pair(
            "stiffness scales", +[](PlantConfig& s) { s.plant.stiffness_scale = 0.0; })));

}  // namespace
}  // namespace reed::plant
