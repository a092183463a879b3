// What surrounds the work of every program, each in a process of its own.
#include "reed/rt/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace reed::rt {
namespace {

using ::testing::ExitedWithCode;

template <typename Thrown>
int EndOf(const Thrown& thrown) {
  return RunProgram("reed_test", [&]() -> int { throw thrown; });
}

TEST(Program, WhateverIsThrownIsOneLineAndAStatus) {
  EXPECT_EXIT(_exit(EndOf(std::invalid_argument("bad key"))), ExitedWithCode(2), "^reed_test: bad key\n$");
  EXPECT_EXIT(_exit(EndOf(Failure("no bus", 3))), ExitedWithCode(3), "^reed_test: no bus\n$");
  EXPECT_EXIT(_exit(EndOf(std::bad_alloc())), ExitedWithCode(3), "^reed_test: out of memory\n$");
  EXPECT_EXIT(_exit(EndOf(42)), ExitedWithCode(3), "^reed_test: ended by an exception of unknown kind\n$");
  EXPECT_EQ(RunProgram("reed_test", [] { return 1; }), 1);
}

/// 0: the first file that is opened has none of the standard streams' numbers.
int FirstFileWithClosedStreams() {
  for (const int stream : {0, 1, 2}) close(stream);
  PrepareProcess();
  const int file = open("/dev/null", O_WRONLY);
  return file > 2 && write(2, "x", 1) == 1 && write(1, "x", 1) == 1 ? 0 : 1;
}

TEST(Program, NoFileTakesTheNumberOfAClosedStream) {
  EXPECT_EXIT(_exit(FirstFileWithClosedStreams()), ExitedWithCode(0), "");
}

int WriteToAPipeWhoseReaderLeft() {
  PrepareProcess();
  int ends[2];
  if (pipe(ends) != 0) return 9;
  close(ends[0]);
  return write(ends[1], "x", 1) < 0 && errno == EPIPE ? 0 : 1;
}

int WriteBeyondTheLimitOfFiles(const std::string& path) {
  PrepareProcess();
  const rlimit limit{10, 10};
  setrlimit(RLIMIT_FSIZE, &limit);
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const char bytes[20] = {};
  const bool half = write(file, bytes, sizeof bytes) == 10;
  return half && write(file, bytes, sizeof bytes) < 0 && errno == EFBIG ? 0 : 1;
}

TEST(Program, AReaderThatLeavesAndAFileThatMayNotGrowAreErrorsAndNoEnd) {
  EXPECT_EXIT(_exit(WriteToAPipeWhoseReaderLeft()), ExitedWithCode(0), "");
  const std::string path = ::testing::TempDir() + "/reed_limited_" + std::to_string(getpid());
  EXPECT_EXIT(_exit(WriteBeyondTheLimitOfFiles(path)), ExitedWithCode(0), "");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace reed::rt
