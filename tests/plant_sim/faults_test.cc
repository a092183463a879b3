// Faults between the simulated robot and its bus port: every kind does something, in its window and nowhere else.
#include <gmock/gmock.h>

#include <map>

#include "reed/plant/faults/fault_checks.h"
#include "reed/plant/faults/injector.h"
#include "reed/plant/faults/kinds.h"
#include "reed/tests/plant_sim/lockstep_rig.h"

namespace reed::plant {
namespace {

FaultConfig FaultOf(const std::string& target, const std::string& kind, int from_cycle = 10) {
  FaultConfig fault;
  fault.id = "one";
  fault.target = target;
  fault.kind = kind;
  fault.from_cycle = from_cycle;
  return fault;
}

PlantConfig Moving(std::vector<FaultConfig> faults = {}) {
  PlantConfig config = TwoJointScenario();
  config.faults = std::move(faults);
  return config;
}

/// All that leaves the plant and where the arm goes, cycle by cycle.
using Course = std::vector<std::vector<double>>;

class Faulty : public Lockstep {
 protected:
  static constexpr std::uint32_t kCycles = 60;

  Course CourseOf(const PlantConfig& config) {
    body_ = RotorBody();
    body_.force_N = Eigen::Vector3d(1.0, -2.0, 8.0);
    wire_.controller.inbox().clear();
    wire_.plant.inbox().clear();
    FakeController controller(wire_.controller);
    Start(config);
    Course course;
    const auto first = static_cast<std::uint32_t>(config.timing.first_cycle);
    for (std::uint32_t k = 0; k < kCycles; ++k) {
      const double tau_Nm = kTau_Nm * (k % 7 < 4 ? 1.0 : -0.5);
      controller.Sync(first + k);
      endpoint_->Poll(0);
      const std::vector<bus::Frame> frames = wire_.controller.inbox();
      wire_.controller.inbox().clear();
      controller.Command(first + k, k == 0 ? DriveRequest::kReady : DriveRequest::kEnable, tau_Nm);
      endpoint_->Poll(0);
      std::vector<double> row{static_cast<double>(frames.size()), body_.brakes};
      for (const bus::Frame& frame : frames) {
        row.push_back(frame.id);
        row.push_back(frame.size);
        row.insert(row.end(), frame.data.begin(), frame.data.end());
      }
      for (const double angle : body_.truth().motor_angle_rad) row.push_back(angle);
      course.push_back(row);
    }
    return course;
  }

  /// First and last cycle that differ from the run without faults; -1: none.
  std::pair<int, int> Differs(const Course& with) {
    const Course without = CourseOf(Moving());
    int first = -1, last = -1;
    for (std::size_t k = 0; k < without.size(); ++k) {
      if (with[k] == without[k]) continue;
      if (first < 0) first = static_cast<int>(k);
      last = static_cast<int>(k);
    }
    return {first, last};
  }
};

std::vector<std::string> TargetsOf(const Kind& kind) {
  std::vector<std::string> found;
  for (const char* target :
       {"joint1.encoder", "joint2.speed", "joint1.torque", "wrench.force_z", "joint2.frame", "wrench.frame",
        "sync.frame", "command.frame", "bus", "joint1.drive", "joint2.brake", "joint1.node", "controller"})
    if (Fits(kind.seats, ParseTarget(target)->seat)) found.emplace_back(target);
  return found;
}

TEST_F(Faulty, EveryKindDoesSomethingAtEveryTargetThatItFitsAndNothingBefore) {
  for (const Kind* kind : AllKinds()) {
    for (const std::string& target : TargetsOf(*kind)) {
      FaultConfig fault = FaultOf(target, kind->name);
      if (fault.kind == "brake_stuck_open") fault.from_cycle = 1;  // while they are closed
      if (fault.kind == "saturation") fault.size = 1e-3;
      if (fault.kind == "coarse" || fault.kind == "backlash") fault.size = 3.0;
      if (fault.kind == "swapped_channel" && target == "joint1.encoder")
        continue;  // both joints move alike here
      ASSERT_FALSE(FindProblem(Moving({fault})))
          << fault.kind << " " << target << ": " << FindProblem(Moving({fault}))->text;
      const auto [first, last] = Differs(CourseOf(Moving({fault})));
      EXPECT_GE(first, fault.from_cycle) << fault.kind << " of " << target << " came early, or never (-1)";
    }
  }
}

TEST_F(Faulty, AWindowHasItsFirstAndLastCycle) {
  FaultConfig fault = FaultOf("joint2.frame", "loss", -1);
  fault.from_s = 0.010;
  fault.duration_s = 0.005;
  const Course course = CourseOf(Moving({fault}));
  std::vector<std::size_t> lost;
  for (std::size_t k = 0; k < course.size(); ++k)
    if (course[k][0] == 2.0) lost.push_back(k);
  EXPECT_EQ(lost, (std::vector<std::size_t>{12, 13, 14, 15, 16})) << "enabled at 2T";
  EXPECT_EQ(recorder_.Count(PlantEvent::kFaultBegins), 1);
  EXPECT_EQ(recorder_.Count(PlantEvent::kFaultEnds), 1);
}

TEST_F(Faulty, ACycleIsCountedFromTheRunsFirstOne) {
  PlantConfig plain = Moving({FaultOf("joint1.drive", "torque_offset")}), crossing = plain;
  crossing.timing.first_cycle = 0x1'0000'0000 - 32;  // its lower bits in the answers are the same
  const auto angles = [](const Course& course) {
    std::vector<double> found;
    for (const std::vector<double>& row : course) found.push_back(row[row.size() - 2]);
    return found;
  };
  EXPECT_EQ(angles(CourseOf(crossing)), angles(CourseOf(plain)));
  EXPECT_NE(angles(CourseOf(plain)), angles(CourseOf(Moving())));
}

TEST_F(Faulty, AWindowEndsAlsoWhereNoSyncReachesTheArm) {
  FaultConfig fault = FaultOf("bus", "blocking");
  fault.duration_s = 0.010;
  const Course course = CourseOf(Moving({fault}));
  for (std::size_t k = 12; k < 20; ++k) EXPECT_EQ(course[k][0], 0.0) << k;
  EXPECT_GT(course[25][0], 0.0) << "the bus is free again";
  EXPECT_EQ(recorder_.Count(PlantEvent::kFaultEnds), 1);
}

TEST_F(Faulty, ProbabilityComesFromTheSeedAndFromTheFaultsOwnName) {
  FaultConfig fault = FaultOf("joint2.frame", "loss");
  fault.probability = 0.5;
  const Course once = CourseOf(Moving({fault}));
  EXPECT_EQ(CourseOf(Moving({fault})), once);
  PlantConfig other_seed = Moving({fault});
  other_seed.seed = 99;
  EXPECT_NE(CourseOf(other_seed), once);
}

TEST_F(Faulty, ASignalThatStaysBeyondItsLevelStartsAFault) {
  FaultConfig fault = FaultOf("joint2.frame", "loss", -1);
  fault.signal = "joint1.speed_radps";
  fault.level = 0.05;
  fault.for_s = 0.003;
  const Course course = CourseOf(Moving({fault}));
  std::size_t first = 0;
  while (first < course.size() && course[first][0] == 3.0) ++first;
  // The body moves from the period after SYNC 2; 4 N·m on 0.5 kg·m² make 8 mrad/s a cycle: beyond the level at SYNC 9.
  EXPECT_GT(first, 10U);
  EXPECT_LT(first, 40U);
}

TEST_F(Faulty, AFaultMayBeginWithAnother) {
  FaultConfig first = FaultOf("joint1.frame", "loss");
  FaultConfig second = FaultOf("joint2.frame", "loss", -1);
  second.id = "two";
  second.from_event = "one";
  second.delay_s = 0.005;
  const Course course = CourseOf(Moving({first, second}));
  EXPECT_EQ(course[9][0], 3.0);
  EXPECT_EQ(course[10][0], 2.0);
  EXPECT_EQ(course[14][0], 2.0);
  EXPECT_EQ(course[15][0], 1.0);
  const Course turned =
      CourseOf(Moving({second, first}));  // one that is later in the list is seen a cycle later
  EXPECT_EQ(turned[15][0], 2.0);
  EXPECT_EQ(turned[16][0], 1.0);
}

TEST(Faults, ThatNothingWouldApplyAreRefused) {
  const auto problem = [](const FaultConfig& fault, std::vector<FaultConfig> before = {}) {
    before.push_back(fault);
    const auto found = FindProblem(Moving(before), 1.0);
    return found ? found->key + ": " + found->text : std::string("accepted");
  };
  using testing::HasSubstr;
  const FaultConfig sound = FaultOf("joint1.encoder", "offset");
  EXPECT_EQ(problem(sound), "accepted");
  const auto changed = [&](auto change) {
    FaultConfig fault = sound;
    change(fault);
    return problem(fault);
  };
  EXPECT_THAT(changed([](FaultConfig& f) { f.kind = "ofset"; }),
              HasSubstr("kind: 'ofset' is unknown; allowed: offset"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.target = "joint3.encoder"; }),
              HasSubstr("the arm has 2 joints"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.target = "joint1.brake"; }),
              HasSubstr("cannot have the kind offset"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.target = "elbow"; }), HasSubstr("is unknown to the kind"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.from_cycle = -1; }), HasSubstr("nothing starts it"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.from_s = 0.1; }), HasSubstr("more than one thing"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.from_cycle = -1, f.from_s = 2.0; }), HasSubstr("never begin"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.from_cycle = -1, f.from_event = "contact_made"; }),
              HasSubstr("no wall"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.from_cycle = -1, f.from_event = "other"; }),
              HasSubstr("no other fault"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.from_cycle = -1, f.signal = "joint3.angle_rad"; }),
              HasSubstr("signal"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.probability = 0.0; }), HasSubstr("never act"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.duration_s = 1e-4; }), HasSubstr("not act in any cycle"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.kind = "gain", f.size = 1.0; }), HasSubstr("changes nothing"));
  EXPECT_THAT(changed([](FaultConfig& f) { f.kind = "stuck", f.size = 1.0; }), HasSubstr("has no size"));
  FaultConfig stuck = FaultOf("joints.encoder", "stuck");
  stuck.id = "two";
  EXPECT_THAT(problem(stuck, {sound}), HasSubstr("contradicts the fault 'one'"));
  EXPECT_THAT(problem(sound, {sound}), HasSubstr("another fault's too"));
}

TEST(Faults, HaveAtLeastFortyKindsEachWithItsOwnName) {
  std::map<std::string, int> names;
  for (const Kind* kind : AllKinds()) ++names[kind->name];
  EXPECT_GE(names.size(), 40U);
  for (const auto& [name, count] : names) EXPECT_EQ(count, 1) << name;
}

}  // namespace
}  // namespace reed::plant
