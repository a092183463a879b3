// The ordinary thread that turns records into LCM messages, log entries and lines on the terminal.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "reed/plant/record/encode.h"
#include "reed/rt/spsc_ring.h"
#include "reed/telemetry/event_log.h"
#include "reed/telemetry/lcm_publisher.h"
#include "reed/telemetry/rate_limit.h"

namespace reed::plant {

enum class WhenFull { kWait, kDrop };  // lockstep loses nothing; realtime waits for nobody

struct PublisherConfig {
  std::string log_path;  // empty: no log
  bool network = true;
  bool console = true;  // events as lines on standard output
  WhenFull when_full = WhenFull::kDrop;
  const std::atomic<bool>* stop =
      nullptr;  // kWait: once set, a log that takes nothing is waited for no longer
};

/// Put is called by one thread. The constructor throws std::runtime_error when the log cannot be created; a
/// network that cannot be opened costs one line on standard error and nothing else.
class Publisher final : public RecordSink {
 public:
  explicit Publisher(const PublisherConfig& config);
  ~Publisher() override;
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// RT: safe with kDrop; with kWait it sleeps while the queue is full.
  void Put(const Record& record) noexcept override;

  /// Everything put so far reaches log and network, the log is on its file, the thread has ended. False when
  /// the log is incomplete. Called by the destructor if not before. A log that takes nothing for
  /// rt::kDiskPatience_ns ends the process, which cannot end the thread.
  bool Finish();

  std::int64_t dropped() const noexcept { return dropped_; }

 private:
  /// Four seconds of 1 kHz; who waits for room needs what comes between two looks of the thread.
  static constexpr std::size_t kCapacity = 4096, kWaitingCapacity = 1024;
  /// Per channel: what a listener is spared in lockstep.
  static constexpr std::int64_t kPublishPerSecond = 1000, kPublishBurst = 100;

  /// After the stop that the run shall have, a disk is waited for so long in all.
  bool OutOfPatience() noexcept;
  void Run();
  bool DrainBatch();  // true: the queue is empty
  void Publish(const Record& record);

  PublisherConfig config_;
  rt::SpscRing<Record> queue_;
  MessageEncoder encoder_;
  telemetry::EventLog log_;
  telemetry::LcmPublisher network_;
  std::vector<telemetry::RateLimit> limits_;  // by kind of record
  std::int64_t dropped_ = 0;
  std::int64_t patient_until_ns_ = 0;
  std::atomic<bool> finish_{false}, done_{false};
  std::atomic<std::int64_t> progress_{0};  // records that are through
  std::thread thread_;
};

}  // namespace reed::plant
