#include "reed/plant/record/lcm_sinks.h"

#include <fcntl.h>
#include <lcm/eventlog.h>
#include <lcm/lcm.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace reed::plant {
namespace {

/// liblcm explains a missing route in a dozen lines on standard error; one line of ours replaces them.
class QuietStandardError {
 public:
  QuietStandardError() : kept_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    std::fflush(stderr);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~QuietStandardError() {
    std::fflush(stderr);
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int kept_;
};

}  // namespace

EventLogFile::EventLogFile(const std::string& path) : log_(lcm_eventlog_create(path.c_str(), "w")) {
  if (!log_) throw std::runtime_error("cannot write the log " + path + ": " + std::strerror(errno));
}

bool EventLogFile::Write(std::int64_t utime, const char* channel, std::span<const std::uint8_t> data) {
  // liblcm takes non-const pointers but only reads through them; the copies keep that promise visible.
  std::vector<char> name(channel, channel + std::strlen(channel) + 1);
  std::vector<std::uint8_t> bytes(data.begin(), data.end());
  lcm_eventlog_event_t event{};
  event.timestamp = utime;
  event.channellen = static_cast<std::int32_t>(name.size() - 1);
  event.datalen = static_cast<std::int32_t>(bytes.size());
  event.channel = name.data();
  event.data = bytes.data();
  return lcm_eventlog_write_event(log_.get(), &event) == 0;
}

bool EventLogFile::Flush() { return std::fflush(log_->f) == 0; }

void EventLogFile::Close::operator()(_lcm_eventlog_t* log) const { lcm_eventlog_destroy(log); }

LcmNetwork::LcmNetwork() {
  const char* asked =
      std::getenv("LCM_DEFAULT_URL");  // NOLINT(concurrency-mt-unsafe): before any thread starts
  const std::string url = asked != nullptr && *asked != '\0' ? asked : "udpm://239.255.76.67:7667?ttl=0";
  {
    const QuietStandardError quiet;
    lcm_.reset(lcm_create(url.c_str()));
  }
  if (lcm_) return;
  trouble_ = "LCM network off: cannot open " + url;
  if (url.starts_with("udpm")) {
    trouble_ +=
        " (no multicast route?); fix: sudo ip link set lo multicast on; sudo ip route add 224.0.0.0/4 dev lo";
  }
}

void LcmNetwork::Publish(const char* channel, std::span<const std::uint8_t> data) {
  lcm_publish(lcm_.get(), channel, data.data(), static_cast<unsigned>(data.size()));
}

void LcmNetwork::Close::operator()(_lcm_t* lcm) const { lcm_destroy(lcm); }

}  // namespace reed::plant
