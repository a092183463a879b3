// A tape holds every value of a snapshot, gives its inputs back, and stays whole on a full disk.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "reed/firmware/tape/tape_reader.h"
#include "reed/firmware/tape/tape_writer.h"
#include "reed/tests/telemetry/sample_snapshot.h"

namespace reed::tape {
namespace {

using telemetry::Snapshot;
using test::SampleSnapshot;

TEST(TapeCrc, IsThatOfZlib) {
  const char text[] = "123456789";
  std::array<std::uint8_t, 9> bytes{};
  std::memcpy(bytes.data(), text, bytes.size());
  EXPECT_EQ(Crc32(bytes), 0xCBF43926u) << "the check value of CRC-32";
  const std::span<const std::uint8_t> all(bytes);
  EXPECT_EQ(Crc32(all.subspan(4), Crc32(all.first(4))), 0xCBF43926u) << "in two parts";
}

class TapeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "reed_tape_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string Path(const char* name) const { return (folder_ / name).string(); }

  static Header SampleHeader() {
    Header header;
    header.reed = "0.2.0";
    header.commit = "abc\ndef";
    header.scenario = "press";
    header.clock = "lockstep";
    header.rate_hz = 1.0 / 3.0;
    header.joints = 5;
    header.parameters = 6;
    header.enable = true;
    header.config = "[arm]\nname = \"a5\"\n";
    return header;
  }
  std::string Refusal(const std::string& path) const {
    try {
      TapeReader reader(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

TEST_F(TapeTest, TheHeaderComesBack) {
  TapeWriter(Path("tape"), SampleHeader()).End();
  const TapeReader reader(Path("tape"));
  const Header& found = reader.header();
  EXPECT_EQ(found.commit, "abc def") << "one line";
  EXPECT_EQ(found.rate_hz, 1.0 / 3.0);
  EXPECT_EQ(found.joints, 5);
  EXPECT_TRUE(found.enable);
  EXPECT_EQ(found.config, SampleHeader().config);
  EXPECT_GT(found.fields.size(), 60U);
}

TEST_F(TapeTest, InputsAndFramesOfEveryCycleComeBackInOrder) {
  constexpr std::int64_t kCycles = 2000;
  {
    TapeWriter writer(Path("tape"), SampleHeader());
    for (std::int64_t k = 0; k < kCycles; ++k) {
      Snapshot s = SampleSnapshot(k, 5, 6);
      s.loop.start_own_ns = s.time_ns - 7 * k;
      s.loop.end_ns = s.time_ns + 500;
      s.loop.stop_wanted = k > 1990;
      writer.Write(s);
    }
    writer.End();
  }
  TapeReader reader(Path("tape"));
  Snapshot found;
  for (std::int64_t k = 0; k < kCycles; ++k) {
    ASSERT_TRUE(reader.Next(found));
    const Snapshot wanted = SampleSnapshot(k, 5, 6);
    ASSERT_EQ(found.cycle, k);
    ASSERT_EQ(found.loop.start_own_ns, wanted.time_ns - 7 * k);
    ASSERT_EQ(found.loop.end_ns, wanted.time_ns + 500);
    ASSERT_EQ(found.loop.stop_wanted, k > 1990);
    ASSERT_EQ(found.timing.rx_ns, 102);
    ASSERT_EQ(found.bus.frames_tx, wanted.bus.frames_tx);
    ASSERT_EQ(found.frame_bytes, wanted.frame_bytes);
    ASSERT_EQ(std::memcmp(found.frames.data(), wanted.frames.data(), 10), 0);
    ASSERT_EQ(found.num_frames, 2);
  }
  EXPECT_FALSE(reader.complete());
  EXPECT_FALSE(reader.Next(found));
  EXPECT_TRUE(reader.complete());
}

TEST_F(TapeTest, ATapeThatIsCutReadsUpToItsLastWholeCycle) {
  {
    TapeWriter writer(Path("tape"), SampleHeader());
    for (std::int64_t k = 0; k < 100; ++k) writer.Write(SampleSnapshot(k, 5, 6));
    writer.End();
  }
  std::filesystem::resize_file(Path("tape"), std::filesystem::file_size(Path("tape")) - 40);
  TapeReader reader(Path("tape"));
  Snapshot found;
  int count = 0;
  while (reader.Next(found)) ++count;
  EXPECT_EQ(count, 99);
  EXPECT_FALSE(reader.complete());
}

TEST_F(TapeTest, WhatIsNoTapeIsRefusedInOneLine) {
  std::ofstream(Path("foreign")) << "#!/bin/sh";
  EXPECT_NE(Refusal(Path("foreign")).find("is no tape; allowed"), std::string::npos);
  EXPECT_NE(Refusal(Path("none")).find("No such file"), std::string::npos);
  std::ofstream(Path("short")) << "REEDTAPE";
  EXPECT_NE(Refusal(Path("short")).find("its header is damaged"), std::string::npos);
}

/// A file size limit is the one full disk that every user can make. In a child: it cannot be lifted again.
int WriteOntoSmallDisk(const std::string& path, const Header& header) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1'500'000, 1'500'000};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::int64_t written = 0;
  {
    TapeWriter writer(path, header);
    for (std::int64_t k = 0; k < 5000; ++k) writer.Write(SampleSnapshot(k, 5, 6));
    writer.End();
    written = writer.report().written - 2;  // mark and header
    if (writer.report().lost == 0 || written < 500) return 2;
    if (written + writer.report().lost != 5001) return 3;
  }
  TapeReader reader(path);
  Snapshot found;
  std::int64_t count = 0;
  while (reader.Next(found)) ++count;
  return count == written && !reader.complete() ? 0 : 4;
}

TEST_F(TapeTest, AFullDiskLeavesWholeRecords) {
  EXPECT_EXIT(_exit(WriteOntoSmallDisk(Path("tape"), SampleHeader())), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace reed::tape
