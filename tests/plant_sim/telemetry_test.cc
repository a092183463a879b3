#include <fcntl.h>
#include <gtest/gtest.h>
#include <lcm/eventlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <reed/event_t.hpp>
#include <reed/plant_t.hpp>
#include <reed/shape_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "reed/plant/record/publisher.h"

namespace reed::plant {
namespace {

PlantRecord NumberedRecord(int k) {
  PlantRecord record;
  record.utime = std::int64_t{1000} * k;
  record.cycle = k;
  record.t_s = 1e-3 * k;
  record.dof = 2;
  record.motor_angle = {0.5 * k, -1.0};
  record.torque = {3.0, 4.0};
  record.braked = k % 2 == 0;
  record.tip = {0.1, 0.2, 0.3};
  record.gap = 1e9;
  record.potential_J = 7.0;
  record.stalls = std::int64_t{3} * k;
  record.stood_s = 0.25;
  return record;
}

class PublisherLog : public ::testing::Test {
 protected:
  PublisherLog() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = (std::filesystem::path(::testing::TempDir()) /
             (std::string("reed_plant_") + info->name() + ".lcmlog"))
                .string();
  }
  ~PublisherLog() override { std::filesystem::remove(path_); }
  PublisherConfig Config() const { return {path_, false, false, WhenFull::kWait}; }

  std::string path_;
};

TEST_F(PublisherLog, HoldsEveryRecordInOrderWithItsNumbersWhenTheProducerWaits) {
  constexpr int kCount = 20000;
  {
    Publisher publisher(Config());
    for (int k = 0; k < kCount; ++k) publisher.Put(NumberedRecord(k));
    EventRecord event;
    event.utime = 42;
    event.code = PlantEvent::kBrakesReleased;
    event.value = 1.5;
    std::snprintf(event.text.data(), event.text.size(), "brakes released");
    publisher.Put(event);
    EXPECT_TRUE(publisher.Finish());
    EXPECT_EQ(publisher.dropped(), 0);
  }
  lcm_eventlog_t* log = lcm_eventlog_create(path_.c_str(), "r");
  ASSERT_NE(log, nullptr);
  for (int k = 0; k < kCount; ++k) {
    lcm_eventlog_event_t* entry = lcm_eventlog_read_next_event(log);
    ASSERT_NE(entry, nullptr) << k;
    plant_t m;
    ASSERT_EQ(m.decode(entry->data, 0, entry->datalen), entry->datalen);
    const PlantRecord expected = NumberedRecord(k);
    EXPECT_STREQ(entry->channel, "REED_PLANT");
    EXPECT_EQ(entry->timestamp, expected.utime);
    EXPECT_EQ(m.utime, expected.utime);
    EXPECT_EQ(m.cycle, k);
    EXPECT_EQ(m.t_s, expected.t_s);
    EXPECT_EQ(m.motor_angle, (std::vector<double>{0.5 * k, -1.0}));
    EXPECT_EQ(m.torque, (std::vector<double>{3.0, 4.0}));
    EXPECT_EQ(m.braked != 0, expected.braked);
    EXPECT_EQ(m.tip[2], 0.3);
    EXPECT_EQ(m.gap, 1e9);
    EXPECT_EQ(m.potential_J, 7.0);
    EXPECT_EQ(m.stalls, std::int64_t{3} * k);
    EXPECT_EQ(m.stood_s, 0.25);
    lcm_eventlog_free_event(entry);
  }
  lcm_eventlog_event_t* entry = lcm_eventlog_read_next_event(log);
  ASSERT_NE(entry, nullptr);
  event_t m;
  ASSERT_EQ(m.decode(entry->data, 0, entry->datalen), entry->datalen);
  EXPECT_STREQ(entry->channel, "REED_PLANT_EVENT");
  EXPECT_EQ(m.utime, 42);
  EXPECT_EQ(m.code, 203);
  EXPECT_EQ(m.value, 1.5);
  EXPECT_EQ(m.text, "brakes released");
  lcm_eventlog_free_event(entry);
  EXPECT_EQ(lcm_eventlog_read_next_event(log), nullptr);
  lcm_eventlog_destroy(log);
}

TEST_F(PublisherLog, HoldsTheShapeBelowOneDatagram) {
  ShapeRecord record;
  record.utime = 34000;
  record.cycle = 34;
  record.num = kMaxShapePoints;
  for (std::size_t k = 0; k < record.num; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      record.bent[axis][k] = static_cast<float>(100 * axis + k);
      record.rigid[axis][k] = -record.bent[axis][k];
    }
  }
  Publisher(Config()).Put(record);
  lcm_eventlog_t* log = lcm_eventlog_create(path_.c_str(), "r");
  ASSERT_NE(log, nullptr);
  lcm_eventlog_event_t* entry = lcm_eventlog_read_next_event(log);
  ASSERT_NE(entry, nullptr);
  EXPECT_STREQ(entry->channel, "REED_SHAPE");
  EXPECT_LT(entry->datalen, 1400);
  shape_t m;
  ASSERT_EQ(m.decode(entry->data, 0, entry->datalen), entry->datalen);
  EXPECT_EQ(m.utime, 34000);
  EXPECT_EQ(m.cycle, 34);
  ASSERT_EQ(m.num, static_cast<std::int32_t>(kMaxShapePoints));
  const auto last = static_cast<float>(kMaxShapePoints - 1);
  EXPECT_EQ(m.x.back(), last);
  EXPECT_EQ(m.y.back(), 100.0F + last);
  EXPECT_EQ(m.z.back(), 200.0F + last);
  EXPECT_EQ(m.rigid_x.back(), -last);
  EXPECT_EQ(m.rigid_y.back(), -100.0F - last);
  EXPECT_EQ(m.rigid_z.back(), -200.0F - last);
  lcm_eventlog_free_event(entry);
  lcm_eventlog_destroy(log);
}

TEST_F(PublisherLog, EqualRecordsMakeEqualFiles) {
  const auto bytes = [this] {
    {
      Publisher publisher(Config());
      for (int k = 0; k < 500; ++k) publisher.Put(NumberedRecord(k));
    }
    std::FILE* file = std::fopen(path_.c_str(), "rb");
    std::string content(std::filesystem::file_size(path_), '\0');
    EXPECT_EQ(std::fread(content.data(), 1, content.size(), file), content.size());
    std::fclose(file);
    return content;
  };
  const std::string first = bytes();
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_EQ(first, bytes());
}

/// Messages up to the end of the file; -1 when the last one is not whole.
int WholeMessages(const std::string& path) {
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(path));
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  int count = 0;
  std::int64_t read_bytes = 0;
  while (lcm_eventlog_event_t* entry = lcm_eventlog_read_next_event(log)) {
    constexpr int kHeaderBytes = 28;
    read_bytes += kHeaderBytes + entry->channellen + entry->datalen;
    ++count;
    lcm_eventlog_free_event(entry);
  }
  lcm_eventlog_destroy(log);
  return read_bytes == bytes ? count : -1;
}

TEST_F(PublisherLog, HoldsWholeRecordsAtAnyTimeSoThatAKilledPlantLeavesALogToRead) {
  constexpr int kCount = 700;  // no multiple of what is written at once
  Publisher publisher(Config());
  for (int k = 0; k < kCount; ++k) publisher.Put(NumberedRecord(k));
  int seen = 0;
  for (int tries = 0; tries < 500 && seen < kCount; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    seen = WholeMessages(path_);
  }
  EXPECT_EQ(seen, kCount) << "the file ends with a whole record soon after the last one";
}

TEST_F(PublisherLog, AFullDiskIsReportedAndDelaysNobody) {
  Publisher publisher({"/dev/full", false, false, WhenFull::kWait});
  for (int k = 0; k < 20000; ++k) publisher.Put(NumberedRecord(k));
  EXPECT_FALSE(publisher.Finish());
}

int PublishIntoAPipeThatNobodyReads(const std::string& fifo) {
  if (mkfifo(fifo.c_str(), 0600) != 0) return 99;
  const int reader = open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
  const std::atomic<bool> stop{true};
  Publisher publisher({fifo, false, false, WhenFull::kWait, &stop});
  for (int k = 0; k < 20000; ++k) publisher.Put(NumberedRecord(k));  // ends, although nothing is taken
  std::fprintf(stderr, "dropped %d, ", publisher.dropped() > 0 ? 1 : 0);
  publisher.Finish();
  close(reader);
  return 0;
}

TEST_F(PublisherLog, ALogThatTakesNothingIsNamedAndGivenUpOnceTheRunShallStop) {
  EXPECT_EXIT(_exit(PublishIntoAPipeThatNobodyReads(path_)), ::testing::ExitedWithCode(3),
              "dropped 1, .*lcmlog: takes nothing any more and was given up");
}

TEST_F(PublisherLog, APathThatCannotBeWrittenIsOneClearError) {
  try {
    Publisher publisher({"/no/such/folder/x.lcmlog", false, false, WhenFull::kWait});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/x.lcmlog: No such file"), std::string::npos);
  }
}

}  // namespace
}  // namespace reed::plant
