// Stamps what happened with cycle and utime and hands it to the recorder. RT: safe (fixed text buffer, no
// heap).
#pragma once

#include <cstdint>

#include "reed/bus/codec/messages.h"
#include "reed/plant/record/records.h"

namespace reed::plant {

class Journal {
 public:
  explicit Journal(RecordSink& recorder) : recorder_(recorder) {}

  /// The stamp of everything noted from here on.
  void Stamp(std::int64_t cycle, std::int64_t utime) noexcept {
    cycle_ = cycle;
    utime_ = utime;
  }

  /// A printf text of one line; `state`: of the drives after the event.
  [[gnu::format(printf, 5, 6)]] void Note(PlantEvent code, bus::DriveState state, double value,
                                          const char* format, ...) noexcept;

  /// Completes the stamp of `record` and passes it on.
  template <typename T>
  void Put(T record) noexcept {
    record.cycle = cycle_;
    record.utime = utime_;
    recorder_.Put(record);
  }

 private:
  RecordSink& recorder_;
  std::int64_t cycle_ = 0;
  std::int64_t utime_ = 0;
};

}  // namespace reed::plant
