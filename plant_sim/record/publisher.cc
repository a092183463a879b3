#include "reed/plant/record/publisher.h"

#include <chrono>
#include <cstdio>

namespace reed::plant {
namespace {

using std::chrono::steady_clock;

std::int64_t MonotonicNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Publisher::Publisher(const PublisherConfig& config)
    : config_(config), limits_(std::variant_size_v<Record>, RateLimit(kNetworkPerSecond)) {
  if (!config_.log_path.empty()) log_ = std::make_unique<EventLogFile>(config_.log_path);
  if (config_.network) {
    network_ = std::make_unique<LcmNetwork>();
    if (!network_->good()) {
      std::fprintf(stderr, "reed_plant_sim: %s\n", network_->trouble().c_str());
      network_.reset();
    }
  }
  thread_ = std::thread([this] { Run(); });
}

Publisher::~Publisher() { Finish(); }

void Publisher::Put(const Record& record) noexcept {
  while (!queue_.TryPush(record)) {
    if (config_.when_full == WhenFull::kDrop) {
      ++dropped_;
      return;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

bool Publisher::Finish() {
  finish_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
  return log_complete_;
}

void Publisher::Run() {
  Record record;
  bool last_round = false;
  while (!last_round) {
    // Read before draining: what was put before Finish is then surely drained in this last round.
    last_round = finish_.load(std::memory_order_acquire);
    while (queue_.TryPop(record)) Publish(record);
    // Asking for data this often costs less than a wake-up per record would cost the simulation; a listener
    // wants small bursts, a log alone does not mind large ones.
    if (!last_round) std::this_thread::sleep_for(std::chrono::milliseconds(network_ ? 2 : 10));
  }
  if (log_ && !log_->Flush() && log_complete_) {
    log_complete_ = false;
    std::fprintf(stderr, "reed_plant_sim: the log is incomplete: its disk takes no more\n");
  }
}

void Publisher::Publish(const Record& record) {
  const Message message = encoder_.Encode(record);
  if (log_ && log_complete_ && !log_->Write(message.utime, message.channel, message.bytes)) {
    log_complete_ = false;
    std::fprintf(stderr, "reed_plant_sim: the log ends at utime %lld: its disk takes no more\n",
                 static_cast<long long>(message.utime));
  }
  if (network_ && limits_[record.index()].Allow(MonotonicNs()))
    network_->Publish(message.channel, message.bytes);
  if (const auto* event = std::get_if<EventRecord>(&record); event != nullptr && config_.console) {
    std::printf("%s\n", event->text.data());
    std::fflush(stdout);
  }
}

}  // namespace reed::plant
