// What is on the disk while a run goes on: whole records only, so that a program that is killed leaves a log
// that can be read to its end.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "reed/telemetry/event_log.h"

namespace reed::telemetry {
namespace {

TEST(RecordFile, TheKernelSeesRecordsAtAFlushAndNotBefore) {
  std::string folder = (std::filesystem::temp_directory_path() / "reed_record_file_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string path = folder + "/log";
  {
    EventLog log(path);
    const std::vector<std::uint8_t> message(1500);
    for (int i = 0; i < 511; ++i) log.Write("REED_TEST", message, i);
    EXPECT_EQ(std::filesystem::file_size(path), 0U);
    log.Write("REED_TEST", message, 511);
    const std::uintmax_t full = std::filesystem::file_size(path);
    EXPECT_EQ(full % 512, 0U) << "512 equal records";
    EXPECT_GT(full, 512 * message.size());
    log.Write("REED_TEST", message, 512);
    EXPECT_EQ(std::filesystem::file_size(path), full);
    log.Flush();
    EXPECT_EQ(std::filesystem::file_size(path), full / 512 * 513);
    EXPECT_EQ(log.report().lost, 0);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace reed::telemetry
