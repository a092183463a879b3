// LCM event log file (lcm-logplayer, lcm-spy and the Python package read it). For an ordinary thread.
#pragma once

#include <lcm/lcm.h>

#include <cstdint>
#include <memory>
#include <string>

#include "reed/telemetry/message.h"
#include "reed/telemetry/record_file.h"

namespace reed::telemetry {

class EventLog {
 public:
  /// Replaces the file. An empty path makes a log that ignores everything.
  /// @throws std::runtime_error with one line if the file cannot be made
  explicit EventLog(const std::string& path);

  bool enabled() const noexcept { return log_ != nullptr; }
  void Write(const char* channel, Bytes message, std::int64_t utime);
  void Flush() { file_.Flush(); }
  const SinkReport& report() const noexcept { return file_.report(); }

 private:
  struct Close {
    void operator()(lcm_eventlog_t* log) const { lcm_eventlog_destroy(log); }
  };
  RecordBuffer buffer_ = MakeRecordBuffer();
  std::unique_ptr<lcm_eventlog_t, Close> log_;
  RecordFile file_;
};

}  // namespace reed::telemetry
