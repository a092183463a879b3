// Snapshots to a tape, each record with its checksum. The file is cut back to whole records when the disk is full. For
// an ordinary thread.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "reed/firmware/snapshot/snapshot.h"
#include "reed/firmware/tape/tape_format.h"
#include "reed/firmware/tape/tape_header.h"
#include "reed/telemetry/record_file.h"

namespace reed::tape {

class TapeWriter {
 public:
  /// Replaces the file and writes the header. An empty path makes a tape that ignores everything.
  /// @throws std::runtime_error with one line if the file cannot be made
  TapeWriter(const std::string& path, const Header& header);

  bool enabled() const noexcept { return stream_ != nullptr; }
  void Write(const telemetry::Snapshot& snapshot);
  /// The program ended by itself: a tape without this was cut.
  void End();
  void Flush() { file_.Flush(); }
  const telemetry::SinkReport& report() const noexcept { return file_.report(); }

 private:
  template <typename T>
  void Append(const T* first, std::size_t count = 1);
  void Begin(Kind kind);
  void Finish();

  int joints_, parameters_;
  telemetry::RecordBuffer buffer_;  // none without a file
  telemetry::FileHandle stream_;
  telemetry::RecordFile file_;
  std::vector<std::uint8_t> record_;
  std::size_t used_ = 0;  // of record_
  std::size_t pending_bytes_ = 0;
  std::int64_t cycles_ = 0;
};

}  // namespace reed::tape
