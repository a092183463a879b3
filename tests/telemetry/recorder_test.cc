#include "reed/firmware/record/recorder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "reed/tests/telemetry/sample_snapshot.h"

namespace reed::telemetry {
namespace {

using test::SampleEventText;
using test::SampleSnapshot;

class RecorderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "reed_recorder_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string Path(const char* name) const { return (folder_ / name).string(); }
  RecorderOptions Files() const { return {Path("log"), Path("candump"), "vcan0", false, ""}; }

  std::filesystem::path folder_;
};

struct LoggedEvent {
  std::string channel;
  std::int64_t timestamp;
  std::vector<std::uint8_t> data;
};

std::vector<LoggedEvent> ReadLog(const std::string& path) {
  std::vector<LoggedEvent> events;
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  if (log == nullptr) return events;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    const auto* data = static_cast<const std::uint8_t*>(event->data);
    events.push_back({event->channel, event->timestamp, {data, data + event->datalen}});
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  return events;
}

std::map<std::string, int> CountChannels(const std::vector<LoggedEvent>& events) {
  std::map<std::string, int> count;
  for (const LoggedEvent& event : events) ++count[event.channel];
  return count;
}

template <typename Message>
Message Decode(const std::vector<std::uint8_t>& data) {
  Message message;
  EXPECT_EQ(message.decode(data.data(), 0, static_cast<int>(data.size())), static_cast<int>(data.size()));
  return message;
}

std::vector<std::string> Lines(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Pushes cycles [first, last) the way a loop in lockstep does: waiting where there is no room.
void PushAll(SnapshotRing& ring, std::int64_t first, std::int64_t last) {
  for (std::int64_t cycle = first; cycle < last;) {
    if (ring.Push(SampleSnapshot(cycle, 5, 6))) {
      ++cycle;
    } else {
      usleep(100);
    }
  }
}

TEST_F(RecorderTest, FramesAreOmittedFromACanLogAndFromNothingElse) {
  for (const bool candump : {true, false}) {
    RecorderOptions options = Files();
    if (!candump) options.candump_path.clear();
    SnapshotRing ring(4);
    Recorder recorder(options, TimeBase::Lockstep(1000.0), ring, SampleEventText);
    Snapshot snapshot = SampleSnapshot(0, 5, 6);
    snapshot.frames_omitted = 7;
    ASSERT_TRUE(ring.Push(snapshot));
    recorder.Start();
    recorder.Stop();
    const RecorderReport report = recorder.Close();
    EXPECT_EQ(report.frames_omitted, candump ? 7 : 0);
    EXPECT_EQ(report.Problems().size(), candump ? 1U : 0U) << "no CAN log, nothing to complain about";
  }
}

TEST_F(RecorderTest, TheLogHoldsEveryCycleOfEveryChannelInOrder) {
  constexpr std::int64_t kCycles = 1234;
  SnapshotRing ring(64);
  {
    Recorder recorder(Files(), TimeBase::Lockstep(1000.0), ring, SampleEventText);
    recorder.Start();
    PushAll(ring, 0, kCycles);
    recorder.Stop();
    const RecorderReport report = recorder.Close();
    EXPECT_EQ(report.snapshots, kCycles);
    EXPECT_TRUE(report.Problems().empty());
    EXPECT_EQ(report.log.lost, 0);
  }
  const auto events = ReadLog(Path("log"));
  const auto count = CountChannels(events);
  for (const char* channel : {"REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_TIMING"}) {
    EXPECT_EQ(count.at(channel), kCycles) << channel;
  }
  EXPECT_EQ(count.at("REED_EVENT"), 25);
  EXPECT_EQ(count.at("REED_BUS"), 14) << "cycles 0, 100 … 1200, and the last one";

  std::int64_t next = 0;
  for (const LoggedEvent& event : events) {
    if (event.channel != "REED_CONTROL") continue;
    const auto control = Decode<reed::control_t>(event.data);
    ASSERT_EQ(control.cycle, next);
    ASSERT_EQ(control.utime, next * 1000);
    ASSERT_EQ(event.timestamp, next * 1000);
    ASSERT_EQ(control.tau[4], test::Value(15, 4, next));
    ++next;
  }
}

TEST_F(RecorderTest, TheBusCountersOfTheLastCycleAreLoggedOnce) {
  SnapshotRing ring(256);
  PushAll(ring, 0, 201);  // cycle 200 is a regular one: no second copy at the end
  {
    Recorder recorder(Files(), TimeBase::Lockstep(1000.0), ring, SampleEventText);
    recorder.Start();
  }
  EXPECT_EQ(CountChannels(ReadLog(Path("log"))).at("REED_BUS"), 3);
}

TEST_F(RecorderTest, EventsCarryTheTextOfTheirCode) {
  SnapshotRing ring(64);
  PushAll(ring, 50, 51);
  {
    Recorder recorder(Files(), TimeBase::Lockstep(1000.0), ring, SampleEventText);
    recorder.Start();
  }
  for (const LoggedEvent& event : ReadLog(Path("log"))) {
    if (event.channel == "REED_EVENT") {
      EXPECT_EQ(Decode<reed::event_t>(event.data).text, "one");
    }
  }
}

TEST_F(RecorderTest, RunMessagesFrameTheLog) {
  SnapshotRing ring(64);
  PushAll(ring, 0, 30);
  {
    Recorder recorder(Files(), TimeBase::Lockstep(1000.0), ring, SampleEventText);
    reed::run_t run{};
    run.scenario = "press_known";
    run.finished = 0;
    recorder.RecordRun(run);
    recorder.Start();
    recorder.Stop();
    run.finished = 1;
    recorder.RecordRun(run);
    EXPECT_EQ(recorder.Close().log.lost, 0);
  }
  const auto events = ReadLog(Path("log"));
  ASSERT_EQ(CountChannels(events).at("REED_RUN"), 2);
  EXPECT_EQ(events.front().channel, "REED_RUN");
  EXPECT_EQ(events.back().channel, "REED_RUN");
  EXPECT_EQ(Decode<reed::run_t>(events.front().data).scenario, "press_known");
  EXPECT_EQ(Decode<reed::run_t>(events.front().data).utime, 0);
  EXPECT_EQ(Decode<reed::run_t>(events.back().data).finished, 1);
  EXPECT_EQ(Decode<reed::run_t>(events.back().data).utime, 29'000);
}

TEST_F(RecorderTest, CandumpLinesHaveTheFormatOfCandump) {
  SnapshotRing ring(64);
  PushAll(ring, 1500, 1501);
  {
    Recorder recorder(Files(), TimeBase::Lockstep(1000.0), ring, SampleEventText);
    recorder.Start();
  }
  EXPECT_EQ(Lines(Path("candump")),
            (std::vector<std::string>{"(0000000001.500000) vcan0 080##15C5D5E5F606162636465666768696A6B",
                                      "(0000000001.500000) vcan0 101##1DDDEDFE0E1E2E3E4E5E6E7E8E9EAEBEC"}));
}

TEST_F(RecorderTest, InWallTimeFramesCarryTheirOwnTime) {
  SnapshotRing ring(64);
  PushAll(ring, 2, 3);
  {
    Recorder recorder(Files(), TimeBase::WallWithOffset(1'700'000'000'000'000'000), ring, SampleEventText);
    recorder.Start();
  }
  const auto lines = Lines(Path("candump"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].substr(0, 19), "(1700000001.002010)");
  EXPECT_EQ(lines[1].substr(0, 19), "(1700000001.002120)");
}

TEST_F(RecorderTest, EqualRunsGiveEqualBytes) {
  std::array<std::string, 2> logs, candumps;
  for (int run = 0; run < 2; ++run) {
    SnapshotRing ring(run == 0 ? 16 : 512);  // other batches, other moments
    {
      Recorder recorder(Files(), TimeBase::Lockstep(1000.0), ring, SampleEventText);
      recorder.Start();
      PushAll(ring, 0, 700);
    }
    const auto slurp = [](const std::string& path) {
      std::stringstream all;
      all << std::ifstream(path, std::ios::binary).rdbuf();
      return all.str();
    };
    logs[static_cast<std::size_t>(run)] = slurp(Path("log"));
    candumps[static_cast<std::size_t>(run)] = slurp(Path("candump"));
  }
  EXPECT_GT(logs[0].size(), 100'000U);
  EXPECT_TRUE(logs[0] == logs[1]);
  EXPECT_TRUE(candumps[0] == candumps[1]);
}

TEST_F(RecorderTest, AFullDiskIsCountedAndTheRingIsDrainedOn) {
  constexpr std::int64_t kCycles = 3000;
  SnapshotRing ring(64);
  Recorder recorder({"/dev/full", "/dev/full", "vcan0", false, ""}, TimeBase::Lockstep(1000.0), ring,
                    SampleEventText);
  recorder.Start();
  PushAll(ring, 0, kCycles);
  recorder.Stop();
  const RecorderReport report = recorder.Close();
  EXPECT_EQ(report.snapshots, kCycles);
  EXPECT_EQ(report.log.written, 0);
  EXPECT_EQ(report.log.lost, 4 * kCycles + 60 + 31 + 3 * 5);
  EXPECT_EQ(report.candump.lost, 2 * kCycles);
  ASSERT_EQ(report.Problems().size(), 2U);
  EXPECT_EQ(report.Problems()[0],
            "/dev/full: No space left on device; the file ends there (12106 messages lost, 0 written)");
}

int RecordIntoAPipeThatNobodyReads(const std::string& fifo) {
  if (mkfifo(fifo.c_str(), 0600) != 0) return 99;
  const int reader = open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
  SnapshotRing ring(64);
  Recorder recorder({"", fifo, "vcan0", false, ""}, TimeBase::Lockstep(1000.0), ring, SampleEventText);
  recorder.Start();
  constexpr int kStuck = 200;  // ms without room in the ring
  std::int64_t cycle = 0;
  for (int full = 0; full < kStuck;) {
    if (ring.Push(SampleSnapshot(cycle, 5, 6))) {
      ++cycle;
      full = 0;
    } else {
      ++full;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  recorder.Stop();
  close(reader);
  return 0;
}

TEST_F(RecorderTest, AFileThatTakesNothingIsNamedAndGivenUpAfterAWhile) {
  EXPECT_EXIT(_exit(RecordIntoAPipeThatNobodyReads(Path("fifo"))), ::testing::ExitedWithCode(3),
              "fifo: takes nothing any more and was given up");
}

/// A file size limit is the one full disk that every user can make. In a child: it cannot be lifted again.
int RecordOntoSmallDisk(const RecorderOptions& options, std::int64_t cycles) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{2'000'000, 2'000'000};
  setrlimit(RLIMIT_FSIZE, &limit);
  RecorderReport report;
  {
    SnapshotRing ring(64);
    Recorder recorder(options, TimeBase::Lockstep(1000.0), ring, SampleEventText);
    recorder.Start();
    PushAll(ring, 0, cycles);
    report = recorder.Close();
  }
  const auto events = ReadLog(options.log_path);
  if (report.log.written == 0 || report.log.lost == 0) return 2;
  if (report.log.written + report.log.lost != 4 * cycles + cycles / 50 + cycles / 100 + 1 + cycles / 1000 * 5)
    return 3;
  if (static_cast<std::int64_t>(events.size()) != report.log.written) return 4;
  const auto first = Decode<reed::measured_t>(events.front().data);
  return first.cycle == 0 ? 0 : 5;
}

TEST_F(RecorderTest, ADiskThatFillsUpLeavesAReadableLogOfTheBeginning) {
  EXPECT_EXIT(_exit(RecordOntoSmallDisk(Files(), 3000)), ::testing::ExitedWithCode(0), "");
}

TEST_F(RecorderTest, AFileThatCannotBeMadeIsOneLineAtSetUp) {
  SnapshotRing ring(2);
  for (const bool log : {true, false}) {
    RecorderOptions options;
    options.publish = false;
    (log ? options.log_path : options.candump_path) = "/nowhere/file";
    try {
      const Recorder recorder(options, TimeBase::Lockstep(1000.0), ring, SampleEventText);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(),
                std::string(log ? "telemetry log" : "CAN log") + " /nowhere/file: No such file or directory");
    }
  }
}

}  // namespace
}  // namespace reed::telemetry
