// Every pair of mode and event against a table written down a second time, and the supervisor that walks it.
#include <gtest/gtest.h>

#include "reed/core/safety/mode_table.h"
#include "reed/core/safety/supervisor.h"

namespace reed::mode {
namespace {

constexpr Mode kO = Mode::kOff, kR = Mode::kReady, kA = Mode::kActive, kF = Mode::kFault;

// Rows: off, ready, active, fault. Columns: none, enable, start, stop, trip, reset, braked.
constexpr Mode kExpected[kNumModes][kNumEvents] = {
    {kO, kR, kO, kO, kF, kO, kO},
    {kR, kR, kA, kO, kF, kR, kO},
    {kA, kA, kA, kR, kF, kA, kA},
    {kF, kF, kF, kF, kF, kO, kF},
};

TEST(ModeTable, EveryPairOfModeAndEventGoesWhereTheIndependentTableSays) {
  for (int mode = 0; mode < kNumModes; ++mode)
    for (int event = 0; event < kNumEvents; ++event)
      EXPECT_EQ(Next(static_cast<Mode>(mode), static_cast<Event>(event)), kExpected[mode][event])
          << kModeNames[static_cast<std::size_t>(mode)] << " on "
          << kEventNames[static_cast<std::size_t>(event)];
}

TEST(ModeTable, ActiveIsReachedFromReadyByStartOnly) {
  for (int mode = 0; mode < kNumModes; ++mode)
    for (int event = 0; event < kNumEvents; ++event)
      if (static_cast<Mode>(mode) != kA && Next(static_cast<Mode>(mode), static_cast<Event>(event)) == kA) {
        EXPECT_EQ(static_cast<Mode>(mode), kR);
        EXPECT_EQ(static_cast<Event>(event), Event::kStart);
      }
}

/// A healthy arm that does what it is asked, one cycle later.
class Walk {
 public:
  explicit Walk(bool start_wanted) : supervisor(start_wanted) {}

  Event Cycle() {
    seen.drives_ready = asked_ == DriveRequest::kReady;
    seen.drives_enabled = asked_ == DriveRequest::kEnable;
    const Event event = supervisor.Step(seen);
    asked_ = supervisor.Request();
    return event;
  }
  void Cycles(int count) {
    for (int i = 0; i < count; ++i) Cycle();
  }

  Observation seen{.all_fresh = true, .tared = true};
  Supervisor supervisor;

 private:
  DriveRequest asked_ = DriveRequest::kOff;
};

static_assert(sizeof(Supervisor(true).cycles_in_mode()) == 8, "2^31 cycles are 25 days at 1 kHz");

TEST(Supervisor, AHealthyArmWithTheWishGoesOffReadyActive) {
  Walk walk(true);
  walk.Cycles(Supervisor::kFreshInRow - 1);
  EXPECT_EQ(walk.supervisor.mode(), kO);
  EXPECT_EQ(walk.Cycle(), Event::kEnable);
  EXPECT_EQ(walk.supervisor.mode(), kR);
  EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kReady) << "ready is asked for before enable";
  EXPECT_EQ(walk.Cycle(), Event::kNone);
  EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kEnable);
  EXPECT_EQ(walk.Cycle(), Event::kStart);
  EXPECT_EQ(walk.supervisor.mode(), kA);
  EXPECT_EQ(walk.supervisor.cycles_in_mode(), 0);
}

TEST(Supervisor, WithoutTheWishAStreamOfMeasurementsNeverAsksForEnable) {
  Walk walk(false);
  for (int i = 0; i < 5000; ++i) {
    walk.Cycle();
    ASSERT_NE(walk.supervisor.Request(), DriveRequest::kEnable);
  }
  EXPECT_EQ(walk.supervisor.mode(), kR);
}

TEST(Supervisor, DrivesThatEnableThemselvesDoNotMakeTheArmActive) {
  Supervisor supervisor(false);
  const Observation seen{.all_fresh = true, .drives_enabled = true, .tared = true};
  for (int i = 0; i < 1000; ++i) {
    supervisor.Step(seen);
    ASSERT_NE(supervisor.mode(), kA);
    ASSERT_NE(supervisor.Request(), DriveRequest::kEnable);
  }
}

TEST(Supervisor, AGapInTheMeasurementsStartsTheCountOfFreshCyclesAgain) {
  Walk walk(true);
  walk.Cycles(Supervisor::kFreshInRow - 1);
  walk.seen.all_fresh = false;
  walk.Cycle();
  walk.seen.all_fresh = true;
  walk.Cycles(Supervisor::kFreshInRow - 1);
  EXPECT_EQ(walk.supervisor.mode(), kO);
  walk.Cycle();
  EXPECT_EQ(walk.supervisor.mode(), kR);
}

TEST(Supervisor, BrakesStayClosedUntilTheForceSensorIsSettled) {
  Walk walk(true);
  walk.seen.tared = false;
  walk.Cycles(500);
  EXPECT_EQ(walk.supervisor.mode(), kR);
  EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kReady);
  walk.seen.tared = true;
  walk.Cycles(2);
  EXPECT_EQ(walk.supervisor.mode(), kA);
}

TEST(Supervisor, DrivesThatBrakedBeforeTheyWereEnabledAreAskedForOffAndThenAnew) {
  for (const int cycles_in_ready : {0, 1}) {
    Walk walk(true);
    walk.Cycles(Supervisor::kFreshInRow + cycles_in_ready);
    ASSERT_EQ(walk.supervisor.mode(), kR);
    walk.seen.drives_braked = true;
    EXPECT_EQ(walk.Cycle(), Event::kBraked);
    EXPECT_EQ(walk.supervisor.mode(), kO);
    EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kOff);
    walk.seen.drives_braked = false;
    walk.Cycles(Supervisor::kFreshInRow - 1);
    EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kOff) << "long enough for the drives to hear it";
    walk.Cycles(3);
    EXPECT_EQ(walk.supervisor.mode(), kA) << "the wish was never fulfilled, so it still holds";
  }
}

TEST(Supervisor, DrivesThatStayBrakedAreWaitedForAndNotAskedAgainAndAgain) {
  Walk walk(true);
  walk.Cycles(Supervisor::kFreshInRow);
  walk.seen.drives_braked = true;
  int events = 0;
  for (int i = 0; i < 1000; ++i) events += walk.Cycle() != Event::kNone ? 1 : 0;
  EXPECT_EQ(events, 1);
  EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kOff);
}

TEST(Supervisor, StopClosesTheBrakesAndTheWishHasToBeSaidAgain) {
  Walk walk(true);
  walk.Cycles(100);
  ASSERT_EQ(walk.supervisor.mode(), kA);
  walk.seen.stop = true;
  EXPECT_EQ(walk.Cycle(), Event::kStop);
  EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kReady);
  walk.seen.stop = false;
  for (int i = 0; i < 1000; ++i) {
    walk.Cycle();
    ASSERT_NE(walk.supervisor.Request(), DriveRequest::kEnable);
  }
}

TEST(Supervisor, ATripInAnyModeClosesTheBrakesInTheSameCycleAndStaysThere) {
  for (const int cycles_before : {0, Supervisor::kFreshInRow, Supervisor::kFreshInRow + 1, 100}) {
    Walk walk(true);
    walk.Cycles(cycles_before);
    walk.seen.trip = true;
    EXPECT_EQ(walk.Cycle(), Event::kTrip);
    EXPECT_EQ(walk.supervisor.mode(), kF);
    EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kOff);
    walk.seen.trip = false;
    for (const bool stop : {false, true}) {
      walk.seen.stop = stop;
      walk.Cycles(1000);
      EXPECT_EQ(walk.supervisor.mode(), kF);
      EXPECT_EQ(walk.supervisor.Request(), DriveRequest::kOff);
    }
  }
}

TEST(Supervisor, ATripBeatsAStopOfTheSameCycle) {
  Walk walk(true);
  walk.Cycles(100);
  walk.seen.stop = walk.seen.trip = true;
  EXPECT_EQ(walk.Cycle(), Event::kTrip);
}

TEST(Supervisor, ResetLeavesAFaultOnlyOnceItsCauseIsGoneAndDoesNotStartTheArm) {
  Walk walk(true);
  walk.Cycles(100);
  walk.seen.trip = true;
  walk.Cycle();
  walk.seen.reset = true;
  walk.Cycle();
  EXPECT_EQ(walk.supervisor.mode(), kF) << "the cause is still there";
  walk.seen.trip = false;
  EXPECT_EQ(walk.Cycle(), Event::kReset);
  EXPECT_EQ(walk.supervisor.mode(), kO);
  walk.seen.reset = false;
  for (int i = 0; i < 1000; ++i) {
    walk.Cycle();
    ASSERT_NE(walk.supervisor.Request(), DriveRequest::kEnable) << "the wish ended with the fault";
  }
}

}  // namespace
}  // namespace reed::mode
