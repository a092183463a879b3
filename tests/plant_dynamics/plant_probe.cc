// The plant for foreign oracles: prints JSON for the Python tests in this folder.
//   plant_probe arm                                          the arm they all use
//   plant_probe swing LINKS_BEND STIFFNESS_SCALE STEP_S MS   motor and joint angles every 10 ms, driven
//   plant_probe load Q1 ... Q5 FX FY FZ                      tip under a small force, rigid joints, no weight
//   plant_probe bench JOINTS LINKS_BEND ELEMENTS STEP_S SECONDS   processor time per simulated second, in
//                                                            contact; a5 for 0 joints, else equal links; and the
//                                                            tip's path, every 10 ms, on its way to rest
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "reed/plant/dynamics/modes.h"
#include "reed/tests/plant_dynamics/bench.h"

namespace {

using Eigen::VectorXd;
using reed::plant::ArmPlant;

template <typename Sequence>
void PrintList(const char* name, const Sequence& values, const char* end) {
  std::printf("\"%s\": [", name);
  const char* comma = "";
  for (const double value : values) {
    std::printf("%s%.17g", comma, value);
    comma = ", ";
  }
  std::printf("]%s", end);
}

void PrintArm() {
  const reed::ArmDescription arm = reed::test::ArmA5();
  std::printf("{\"dh\": [");
  for (std::size_t i = 0; i < arm.joints.size(); ++i)
    std::printf("%s[%.17g, %.17g, %.17g]", i ? ", " : "", arm.joints[i].rpy_rad.x(), arm.joints[i].xyz_m.x(),
                arm.joints[i].d_m);
  std::printf("], \"bodies\": [");
  for (std::size_t i = 0; i < arm.bodies.size(); ++i) {
    const reed::InertialBody& body = arm.bodies[i];
    std::printf("%s{\"mass\": %.17g, ", i ? ", " : "", body.mass_kg);
    PrintList("com", body.com_m, ", ");
    PrintList("inertia", body.inertia_com_kgm2.reshaped(), "}");
  }
  std::printf("], \"sections\": [");
  for (std::size_t i = 0; i < arm.sections.size(); ++i) {
    const reed::BeamSection& s = arm.sections[i];
    std::printf("%s{\"length\": %.17g, \"EA\": %.17g, \"EI\": %.17g, \"GJ\": %.17g, \"rhoA\": %.17g}",
                i ? ", " : "", s.length_m, s.EA_N, s.EI_Nm2, s.GJ_Nm2, s.rhoA_kgpm);
  }
  std::printf("], ");
  PrintList("gravity", arm.gravity_mps2, ", ");
  PrintList("rotor_inertia", arm.rotor_inertia_kgm2, ", ");
  PrintList("joint_stiffness", arm.joint_stiffness_Nmprad, ", ");
  PrintList("viscous_weights", arm.parameters[2].viscous_weights, ", ");
  std::printf("\"bv\": %.17g}\n", arm.parameters[2].truth);
}

void Swing(bool links_bend, double stiffness_scale, double step_s, int duration_ms) {
  reed::PlantConfig scene;
  scene.arm = reed::TrueOf(reed::test::ArmA5());
  scene.arm.coulomb_Nm.clear();
  scene.plant.flexible_links = links_bend;
  scene.plant.stiffness_scale = stiffness_scale;
  scene.plant.damping_ratio = 0.0;
  scene.plant.max_step_s = step_s;
  ArmPlant plant(scene);
  plant.Reset(reed::test::MidPose());
  std::printf("{");
  PrintList("start", plant.truth().joint_angle_rad, ", \"motor\": [");
  std::vector<VectorXd> joints;
  VectorXd torque(5);
  for (int ms = 0; ms < duration_ms; ++ms) {
    const double t = 1e-3 * ms;
    torque << 4.0 * std::sin(3.0 * t), 8.0 * std::cos(4.0 * t), 3.0 * std::sin(5.0 * t),
        0.8 * std::cos(2.0 * t), 0.2;
    plant.Advance(torque, false, 1e-3);
    if (ms % 10 != 9) continue;
    std::printf("%s", joints.empty() ? "{" : ", {");
    PrintList("q", plant.truth().motor_angle_rad, "}");
    joints.push_back(plant.truth().joint_angle_rad);
  }
  std::printf("], \"joint\": [");
  for (std::size_t i = 0; i < joints.size(); ++i) {
    std::printf("%s", i ? ", {" : "{");
    PrintList("q", joints[i], "}");
  }
  std::printf("]}\n");
}

void Load(char** args) {
  VectorXd q(5);
  for (Eigen::Index i = 0; i < 5; ++i) q[i] = std::atof(args[i]);
  const Eigen::Vector3d force(std::atof(args[5]), std::atof(args[6]), std::atof(args[7]));
  reed::PlantModelConfig config;
  config.joint_stiffness_scale = 1e9;
  reed::plant::ArmModes arm(reed::TrueOf(reed::test::ArmA5()), config, q);
  const Eigen::Vector3d rest = arm.Load(Eigen::Vector3d::Zero(), false);
  std::printf("{");
  PrintList("tip", rest, ", ");
  PrintList("moved", Eigen::Vector3d(arm.Load(force, false) - rest), "}\n");
}

/// `joints` equal links of 0.2 m, every second one twisted by a right angle.
reed::TrueArm Zigzag(int joints) {
  constexpr double kLength = 0.2, kMass = 0.4, kAcross = kMass * kLength * kLength / 12.0;
  reed::TrueArm arm;
  arm.name = "zigzag";
  for (int i = 0; i < joints; ++i) {
    arm.joints.push_back(reed::JointOf({i % 2 == 0 ? 0.0 : 0.5 * std::numbers::pi, 0.0, kLength}));
    arm.bodies.push_back(
        {kMass, {0.0, 0.0, -0.5 * kLength}, Eigen::Vector3d(kAcross, kAcross, 5e-4).asDiagonal()});
    arm.sections.push_back({kLength, 1e7, 800.0, 600.0, kMass / kLength});
    arm.rotor_inertia_kgm2.push_back(0.1);
    arm.joint_stiffness_Nmprad.push_back(5000.0);
  }
  return arm;
}

/// The motors hold their start by a servo, torque held for 1 ms, while the tool presses on a wall.
void Bench(int joints, bool links_bend, int elements, double step_s, double seconds) {
  reed::PlantConfig scene;
  scene.arm = joints > 0 ? Zigzag(joints) : reed::TrueOf(reed::test::ArmA5());
  scene.plant.flexible_links = links_bend;
  scene.plant.elements_per_link = elements;
  scene.plant.max_step_s = step_s;
  const VectorXd pose = joints > 0 ? VectorXd::Constant(joints, 0.4) : reed::test::MidPose();
  const VectorXd K_d =
      100.0 * Eigen::Map<const VectorXd>(scene.arm.rotor_inertia_kgm2.data(), scene.arm.dof());
  ArmPlant probe(scene);
  probe.Reset(pose);
  scene.wall.present = true;
  scene.wall.point_m = probe.truth().tip_m + Eigen::Vector3d(0.0, 0.0, 0.5e-3);
  ArmPlant plant(scene);
  plant.Reset(pose);
  constexpr int kSlice_ms = 50;
  double fewest = 1e9;
  std::vector<double> path_m;
  // The quickest slice: what else runs on this machine does not count.
  for (int slice = 0; slice < static_cast<int>(1e3 * seconds) / kSlice_ms; ++slice) {
    const std::clock_t start = std::clock();
    for (int i = 0; i < kSlice_ms; ++i) {
      const VectorXd torque =
          K_d.cwiseProduct(15.0 * (pose - plant.truth().motor_angle_rad) - plant.truth().motor_speed_radps);
      plant.Advance(torque, false, 1e-3);
      if (i % 10 == 9) path_m.insert(path_m.end(), plant.truth().tip_m.begin(), plant.truth().tip_m.end());
    }
    fewest = std::min(fewest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("{\"coordinates\": %d, \"force_N\": %.6g, \"cpu_per_simulated_s\": %.6g, ",
              plant.num_coordinates(), plant.truth().normal_force_N, fewest / (1e-3 * kSlice_ms));
  PrintList("path_m", path_m, "}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "arm" && argc == 2)
    PrintArm();
  else if (what == "swing" && argc == 6)
    Swing(std::atoi(argv[2]) != 0, std::atof(argv[3]), std::atof(argv[4]), std::atoi(argv[5]));
  else if (what == "load" && argc == 10)
    Load(argv + 2);
  else if (what == "bench" && argc == 7)
    Bench(std::atoi(argv[2]), std::atoi(argv[3]) != 0, std::atoi(argv[4]), std::atof(argv[5]),
          std::atof(argv[6]));
  else
    return std::fputs("usage: see the head of plant_probe.cc\n", stderr), 2;
  return 0;
}
