#include "reed/firmware/record/recorder.h"

#include <pthread.h>

#include "reed/rt/clock.h"
#include "reed/rt/patience.h"

namespace reed::telemetry {
namespace {

/// Polling, because waking this thread would cost the loop a system call; the ring holds many times this.
/// Often where a viewer may listen, because a burst overflows the socket of a slow listener. Rarely where none
/// can, because on one CPU the wake-ups cost as much as a fifth of the loop.
constexpr std::int64_t kPollNs = 2'000'000, kPollUnheardNs = 5'000'000;
/// Snapshots between two looks at the clock.
constexpr int kBatch = 64;
/// How much of a run a crash may cost.
constexpr std::int64_t kFlushNs = 100'000'000;
/// More than a watcher can follow; bursts because the thread wakes up every few ms.
constexpr std::int64_t kPublishPerSecond = 1000, kPublishBurst = 50;

}  // namespace

std::vector<std::string> RecorderReport::Problems() const {
  std::vector<std::string> lines;
  if (!log.problem.empty()) lines.push_back(log.Loss("messages"));
  if (!candump.problem.empty()) lines.push_back(candump.Loss("frames"));
  if (!tape.problem.empty()) lines.push_back(tape.Loss("cycles"));
  if (!lcm.problem.empty()) lines.push_back(lcm.Loss("messages"));
  if (frames_omitted > 0) {
    lines.push_back("CAN log: " + std::to_string(frames_omitted) +
                    " frames omitted, more in one cycle than its record holds");
  }
  return lines;
}

Recorder::Recorder(const RecorderOptions& options, const TimeBase& time, SnapshotRing& ring,
                   EventText event_text)
    : time_(time),
      ring_(ring),
      event_text_(event_text),
      log_(options.log_path),
      candump_(options.candump_path, options.candump_interface),
      tape_(options.tape_path, options.tape_header),
      publisher_(options.lcm_url, options.publish),
      cycle_limit_(kPublishPerSecond, kPublishBurst),
      event_limit_(kPublishPerSecond, kPublishBurst) {}

Recorder::~Recorder() { Stop(); }

void Recorder::RecordRun(reed::run_t run) {
  run.utime = UtimeNow();
  Emit("REED_RUN", encoder_.Run(run), run.utime, true);
  Flush();
}

void Recorder::RecordLawNames(const std::vector<std::string>& names) {
  if (names.empty()) return;
  const std::int64_t utime = UtimeNow();
  Emit("REED_LAW_NAMES", encoder_.LawNames(names, utime), utime, true);
}

std::int64_t Recorder::UtimeNow() const {
  return time_.lockstep() ? last_utime_ : time_.Utime(0, rt::MonotonicClock().NowNs());
}

void Recorder::Start() {
  stop_.store(false, std::memory_order_relaxed);
  done_.store(false, std::memory_order_relaxed);
  thread_ = std::thread([this] { Run(); });
  pthread_setname_np(thread_.native_handle(), "reed-telemetry");
}

void Recorder::Stop() {
  if (!thread_.joinable()) return;
  stop_.store(true, std::memory_order_release);
  if (!rt::AwaitDone(done_, progress_)) rt::AbandonProcess(rt::TakesNothing(*writing_.load()));
  thread_.join();
}

RecorderReport Recorder::Close() {
  Stop();
  Flush();
  writing_.store(&tape_.report().name, std::memory_order_relaxed);
  tape_.End();
  report_.log = log_.report();
  report_.candump = candump_.report();
  report_.tape = tape_.report();
  report_.lcm = publisher_.report();
  if (!publisher_.enabled()) report_.lcm.problem.clear();  // was said at start: publish_problem()
  return report_;
}

void Recorder::Run() {
  const rt::MonotonicClock clock;
  std::int64_t flushed_ns = clock.NowNs();
  while (true) {
    // Read before draining: what was pushed before Stop() is then sure to be seen below.
    const bool stopping = stop_.load(std::memory_order_acquire);
    now_ns_ = clock.NowNs();
    const bool drained = DrainBatch();
    if (drained && stopping) break;
    if (now_ns_ - flushed_ns >= kFlushNs) {
      Flush();
      flushed_ns = now_ns_;
    }
    if (drained) clock.SleepUntil(clock.NowNs() + (publisher_.enabled() ? kPollNs : kPollUnheardNs));
  }
  if (report_.snapshots > 0 && last_cycle_ + kBusPeriodCycles != next_bus_cycle_) {
    RecordBus(last_bus_, last_cycle_, last_utime_);
  }
  if (report_.snapshots % kHistogramPeriodCycles != 0) RecordHistograms();
  Flush();
  done_.store(true, std::memory_order_release);
}

bool Recorder::DrainBatch() {
  // Bounded, so that a producer without pauses (lockstep) does not keep the clock from being read.
  for (int i = 0; i < kBatch; ++i) {
    const Snapshot* snapshot = ring_.Front();
    if (snapshot == nullptr) return true;
    Record(*snapshot);
    ring_.PopFront();
    progress_.fetch_add(1, std::memory_order_relaxed);
  }
  return false;
}

void Recorder::Record(const Snapshot& snapshot) {
  const std::int64_t utime = time_.Utime(snapshot.cycle, snapshot.time_ns);
  const bool publish = publisher_.enabled() && cycle_limit_.Admit(now_ns_);
  if (publisher_.enabled() && !publish) ++report_.thinned;
  if (publish || log_.enabled()) {
    Emit("REED_MEASURED", encoder_.Measured(snapshot, utime), utime, publish);
    Emit("REED_CONTROL", encoder_.Control(snapshot, utime), utime, publish);
    Emit("REED_ADAPTATION", encoder_.Adaptation(snapshot, utime), utime, publish);
    if (snapshot.num_law_values > 0) Emit("REED_LAW", encoder_.Law(snapshot, utime), utime, publish);
    Emit("REED_TIMING", encoder_.Timing(snapshot, utime), utime, publish);
  }
  for (int i = 0; i < snapshot.num_events; ++i) {
    const char* text = event_text_(snapshot.events[static_cast<std::size_t>(i)].code);
    Emit("REED_EVENT", encoder_.Event(snapshot, i, text, utime), utime, event_limit_.Admit(now_ns_));
  }
  if (snapshot.cycle >= next_bus_cycle_) RecordBus(snapshot.bus, snapshot.cycle, utime);

  if (candump_.enabled()) {
    writing_.store(&candump_.report().name, std::memory_order_relaxed);
    snapshot.ForEachFrame([&](const RecordedFrame& recorded) {
      candump_.Write(recorded.frame, time_.Utime(snapshot.cycle, snapshot.time_ns + recorded.offset_ns));
    });
    report_.frames_omitted += snapshot.frames_omitted;
  }
  writing_.store(&tape_.report().name, std::memory_order_relaxed);
  tape_.Write(snapshot);
  ++report_.snapshots;
  last_bus_ = snapshot.bus;
  last_cycle_ = snapshot.cycle;
  last_utime_ = utime;
  histograms_.Add(snapshot.timing);
  if (report_.snapshots % kHistogramPeriodCycles == 0) RecordHistograms();
}

void Recorder::RecordHistograms() {
  for (std::size_t i = 0; i < TimingHistograms::kNames.size(); ++i) {
    histograms_.Fill(i, last_cycle_, last_utime_, histogram_);
    Emit("REED_HISTOGRAM", encoder_.Histogram(histogram_), last_utime_, true);
  }
}

void Recorder::RecordBus(const BusCounters& bus, std::int64_t cycle, std::int64_t utime) {
  Emit("REED_BUS", encoder_.Bus(bus, cycle, utime), utime, true);
  next_bus_cycle_ = cycle + kBusPeriodCycles;
}

void Recorder::Emit(const char* channel, Bytes message, std::int64_t utime, bool publish) {
  writing_.store(&log_.report().name, std::memory_order_relaxed);
  log_.Write(channel, message, utime);
  if (publish) publisher_.Publish(channel, message);
}

void Recorder::Flush() {
  writing_.store(&log_.report().name, std::memory_order_relaxed);
  log_.Flush();
  writing_.store(&candump_.report().name, std::memory_order_relaxed);
  candump_.Flush();
  writing_.store(&tape_.report().name, std::memory_order_relaxed);
  tape_.Flush();
}

}  // namespace reed::telemetry
