// CAN log in the text format of `candump -L`, one line per CAN FD frame: (sec.usec) interface ID##FLAGSDATA.
// canplayer, cantools and python-can read it. For an ordinary thread.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "reed/bus/frame/frame.h"
#include "reed/telemetry/record_file.h"

namespace reed::telemetry {

class CandumpLog {
 public:
  /// Replaces the file. An empty path makes a log that ignores everything.
  /// @throws std::runtime_error with one line if the file cannot be made
  CandumpLog(const std::string& path, const std::string& interface);

  bool enabled() const noexcept { return stream_ != nullptr; }
  void Write(const bus::Frame& frame, std::int64_t utime);
  void Flush() { file_.Flush(); }
  const SinkReport& report() const noexcept { return file_.report(); }

 private:
  std::string middle_;  // of a line: ") name "
  RecordBuffer buffer_ = MakeRecordBuffer();
  FileHandle stream_;
  RecordFile file_;
};

}  // namespace reed::telemetry
