#include "reed/plant/record/publisher.h"

#include <chrono>
#include <cstdio>

#include "reed/rt/monotonic.h"
#include "reed/rt/patience.h"

namespace reed::plant {
namespace {

void Complain(const std::string& problem) {
  if (!problem.empty()) std::fprintf(stderr, "reed_plant_sim: %s\n", problem.c_str());
}

/// How much of a run a crash may cost.
constexpr std::int64_t kFlush_ns = 100'000'000;
/// Records between two looks at the clock.
constexpr int kBatch = 64;

}  // namespace

Publisher::Publisher(const PublisherConfig& config)
    : config_(config),
      queue_(config.when_full == WhenFull::kWait ? kWaitingCapacity : kCapacity),
      log_(config.log_path),
      network_("", config.network),
      limits_(std::variant_size_v<Record>, {kPublishPerSecond, kPublishBurst}) {
  Complain(network_.report().problem);
  thread_ = std::thread([this] { Run(); });
}

Publisher::~Publisher() { Finish(); }

void Publisher::Put(const Record& record) noexcept {
  while (!queue_.Push(record)) {
    if (config_.when_full == WhenFull::kDrop || OutOfPatience()) {
      ++dropped_;
      return;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

bool Publisher::OutOfPatience() noexcept {
  if (config_.stop == nullptr || !config_.stop->load(std::memory_order_relaxed)) return false;
  const std::int64_t now_ns = rt::NowNs();
  if (patient_until_ns_ == 0) patient_until_ns_ = now_ns + rt::kDiskPatience_ns;
  return now_ns > patient_until_ns_;
}

bool Publisher::Finish() {
  finish_.store(true, std::memory_order_release);
  if (thread_.joinable()) {
    if (!rt::AwaitDone(done_, progress_)) rt::AbandonProcess(rt::TakesNothing(config_.log_path));
    thread_.join();
    const telemetry::SinkReport& log = log_.report();
    if (log.lost > 0) Complain(log.Loss("records"));
  }
  return log_.report().lost == 0;
}

void Publisher::Run() {
  std::int64_t flushed_ns = rt::NowNs();
  bool last_round = false;
  while (!last_round) {
    // Read before draining: what was put before Finish is then surely drained in this last round.
    last_round = finish_.load(std::memory_order_acquire);
    const bool drained = DrainBatch();
    if (last_round && !drained) last_round = false;
    if (const std::int64_t now_ns = rt::NowNs(); now_ns - flushed_ns >= kFlush_ns) {
      log_.Flush();
      flushed_ns = now_ns;
    }
    // Asking for data this often costs less than a wake-up per record would cost the simulation; a listener
    // needs small bursts, a log alone can take large ones.
    if (drained && !last_round)
      std::this_thread::sleep_for(std::chrono::milliseconds(network_.enabled() ? 2 : 5));
  }
  log_.Flush();
  done_.store(true, std::memory_order_release);
}

bool Publisher::DrainBatch() {
  // Bounded, so that a producer that never rests (lockstep) does not keep the clock from being read.
  for (int i = 0; i < kBatch; ++i) {
    const Record* record = queue_.Front();
    if (record == nullptr) return true;
    Publish(*record);
    queue_.PopFront();
    progress_.fetch_add(1, std::memory_order_relaxed);
  }
  return false;
}

void Publisher::Publish(const Record& record) {
  const Message message = encoder_.Encode(record);
  log_.Write(message.channel, message.bytes, message.utime);
  if (network_.enabled() && limits_[record.index()].Admit(rt::NowNs()))
    network_.Publish(message.channel, message.bytes);
  if (const auto* event = std::get_if<EventRecord>(&record); event != nullptr && config_.console) {
    std::printf("%s\n", event->text.data());
    std::fflush(stdout);
  }
}

}  // namespace reed::plant
