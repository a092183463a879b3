// Reads a tape, record by record, back into snapshots: the inputs, by their names, so that a program whose cycles have
// other values reads it too. For an ordinary thread.
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

class TapeReader {
 public:
  /// @throws std::runtime_error with one line: no such file, no tape, a tape of a later schema, a damaged header, or one that
  /// lacks an input
  explicit TapeReader(const std::string& path);

  const Header& header() const noexcept { return header_; }
  /// The next cycle's inputs, events left out. False at the end of the tape or of its whole part.
  bool Next(telemetry::Snapshot& snapshot) noexcept;
  /// True once the record was read that says the tape is complete.
  bool complete() const noexcept { return complete_; }

 private:
  bool ReadRecord() noexcept;
  void FindInputs(const std::string& path);

  telemetry::FileHandle file_;
  Header header_;
  RecordHead head_{};
  std::vector<std::uint8_t> payload_;
  std::vector<std::size_t> input_at_;  // offsets in a cycle's payload, in the order of Fields()
  std::size_t fixed_bytes_ = 0;        // behind them: events and frames
  bool complete_ = false;
};

}  // namespace reed::tape
