// The ordinary thread that turns records into LCM messages, log entries and lines on the terminal.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "reed/plant/record/encode.h"
#include "reed/plant/record/lcm_sinks.h"
#include "reed/plant/record/rate_limit.h"
#include "reed/plant/record/record_queue.h"

namespace reed::plant {

enum class WhenFull { kWait, kDrop };  // lockstep loses nothing; the wall clock waits for nobody

struct PublisherConfig {
  std::string log_path;  // empty: no log
  bool network = true;
  bool console = true;  // events as lines on standard output
  WhenFull when_full = WhenFull::kDrop;
};

/// Put is called by one thread. The constructor throws std::runtime_error when the log cannot be created; a
/// network that cannot be opened costs one line on standard error and nothing else.
class Publisher final : public Recorder {
 public:
  explicit Publisher(const PublisherConfig& config);
  ~Publisher() override;
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// RT: safe with kDrop; with kWait it sleeps while the queue is full.
  void Put(const Record& record) noexcept override;

  /// Everything put so far reaches log and network, the log is on its file, the thread has ended. False when
  /// the log is incomplete. Called by the destructor if not before.
  bool Finish();

  std::int64_t dropped() const noexcept { return dropped_; }

 private:
  static constexpr std::size_t kCapacity = 4096;       // four seconds of 1 kHz
  static constexpr double kNetworkPerSecond = 1000.0;  // per channel: what a listener is spared in lockstep

  void Run();
  void Publish(const Record& record);

  PublisherConfig config_;
  RecordQueue queue_{kCapacity};
  MessageEncoder encoder_;
  std::unique_ptr<EventLogFile> log_;
  std::unique_ptr<LcmNetwork> network_;
  std::vector<RateLimit> limits_;  // by kind of record
  bool log_complete_ = true;
  std::int64_t dropped_ = 0;
  std::atomic<bool> finish_{false};
  std::thread thread_;
};

}  // namespace reed::plant
