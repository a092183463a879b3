// A file of records behind a stdio buffer that stays readable when the disk fills up: after the first error
// it is cut back to its last complete flush, and everything from there on is counted as lost. For an ordinary
// thread.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "reed/telemetry/sink_report.h"

namespace reed::telemetry {

/// What stdio collects in; to outlive the file.
using RecordBuffer = std::unique_ptr<char[]>;
RecordBuffer MakeRecordBuffer();

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

/// Made anew for writing; nullptr for an empty path.
/// @throws std::runtime_error with one line, `what` and the path in it, if it cannot be made
FileHandle OpenRecordFile(const std::string& what, const std::string& path);

class RecordFile {
 public:
  /// Watches over `file` (opened by somebody else, nothing written yet, not owned), which gets this buffer;
  /// nullptr: everything is ignored.
  RecordFile(std::FILE* file, const std::string& path, const RecordBuffer& buffer);

  /// True while records may be written; after an error the caller only counts them.
  bool good() const noexcept { return file_ != nullptr && report_.problem.empty(); }

  /// To be called for every record (of at most one datagram): whether stdio took it, or it was not tried.
  void Count(bool taken);
  /// Hands the buffer to the kernel.
  void Flush();

  const SinkReport& report() const noexcept { return report_; }

 private:
  void Fail();

  std::FILE* file_;
  SinkReport report_;
  std::int64_t pending_ = 0;  // records in the buffer
  std::int64_t complete_bytes_ = 0;
};

}  // namespace reed::telemetry
