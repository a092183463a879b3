// The ordinary thread at the other end of the loop's ring: turns every snapshot into LCM messages, CAN log
// lines and a record of the tape, writes all of them to files, and publishes as many as a viewer can take. The loop never waits for it: a
// full disk or a network error is counted and reported at the end, and the ring is still emptied.
//
// Order: construct (opens everything), RecordRun, Start, then the real-time scope and the loop; Stop,
// RecordRun, Close. RT: not for the loop. All calls from one thread.
#pragma once

#include <atomic>
#include <reed/run_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "reed/firmware/record/candump_log.h"
#include "reed/firmware/record/encode.h"
#include "reed/firmware/record/time_base.h"
#include "reed/firmware/record/timing_histograms.h"
#include "reed/firmware/snapshot/snapshot_ring.h"
#include "reed/firmware/tape/tape_writer.h"
#include "reed/telemetry/event_log.h"
#include "reed/telemetry/lcm_publisher.h"
#include "reed/telemetry/rate_limit.h"

namespace reed::telemetry {

/// One line for people about an event's code; never nullptr.
using EventText = const char* (*)(int code);

struct RecorderOptions {
  std::string log_path;                   // LCM event log; empty: none
  std::string candump_path;               // CAN log; empty: none
  std::string candump_interface = "can";  // the interface's name in the CAN log
  bool publish = true;                    // over the network
  std::string lcm_url;                    // empty: LCM_DEFAULT_URL, or else the local default
  std::string tape_path{};                // empty: none
  tape::Header tape_header{};
};

struct RecorderReport {
  std::int64_t snapshots = 0;       // taken out of the ring
  std::int64_t thinned = 0;         // of these, not published over LCM to stay below 1000 per second
  std::int64_t frames_omitted = 0;  // of the CAN log: frames that found no room in their snapshot
  SinkReport log, candump, tape, lcm;

  /// One line per thing that went wrong: what, how many, fix.
  std::vector<std::string> Problems() const;
};

class Recorder {
 public:
  /// Bus counters go out every so many cycles.
  static constexpr std::int64_t kBusPeriodCycles = 100;
  /// Histograms go out every so many cycles, and at the end.
  static constexpr std::int64_t kHistogramPeriodCycles = 1000;

  /// @throws std::runtime_error with one line if a file cannot be made
  Recorder(const RecorderOptions& options, const TimeBase& time, SnapshotRing& ring, EventText event_text);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Why LCM is not used although it was asked for, with the fix; empty: all is well. Known from construction
  /// on.
  const std::string& publish_problem() const noexcept { return publisher_.report().problem; }

  /// Logs and publishes a run message, with its utime set here. Before Start() or after Stop() only.
  void RecordRun(reed::run_t run);
  /// Logs and publishes what the law's values are called; nothing where it shows none. As RecordRun.
  void RecordLawNames(const std::vector<std::string>& names);

  /// Starts the thread. Before the real-time scope, whose priority and core it would inherit.
  void Start();
  /// Takes out what is left in the ring and ends the thread. Nobody may push meanwhile. A file that takes nothing for
  /// rt::kDiskPatience_ns ends the process, which cannot end the thread.
  void Stop();
  /// Completes the files' reports; after Stop(). The files themselves are closed by the destructor.
  RecorderReport Close();

 private:
  std::int64_t UtimeNow() const;  // before Start() or after Stop()
  void Run();
  bool DrainBatch();  // true: the ring is empty
  void Record(const Snapshot& snapshot);
  void RecordHistograms();
  void RecordBus(const BusCounters& bus, std::int64_t cycle, std::int64_t utime);
  void Emit(const char* channel, Bytes message, std::int64_t utime, bool publish);
  void Flush();

  TimeBase time_;
  SnapshotRing& ring_;
  EventText event_text_;
  EventLog log_;
  CandumpLog candump_;
  tape::TapeWriter tape_;
  LcmPublisher publisher_;
  MessageEncoder encoder_;
  RateLimit cycle_limit_, event_limit_;
  RecorderReport report_;
  TimingHistograms histograms_;
  reed::histogram_t histogram_;
  BusCounters last_bus_;  // for the counters at the end
  std::int64_t last_cycle_ = 0;
  std::int64_t last_utime_ = 0;
  std::int64_t next_bus_cycle_ = 0;
  std::int64_t now_ns_ = 0;  // CLOCK_MONOTONIC at the start of the batch
  std::atomic<bool> stop_{false}, done_{false};
  std::atomic<std::int64_t> progress_{0};             // snapshots that are through
  std::atomic<const std::string*> writing_{nullptr};  // the file that the thread is, or was last, at
  std::thread thread_;
};

}  // namespace reed::telemetry
