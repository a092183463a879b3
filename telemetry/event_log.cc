#include "reed/telemetry/event_log.h"

#include <cstring>
#include <stdexcept>

#include "reed/rt/errno_text.h"

namespace reed::telemetry {
namespace {

lcm_eventlog_t* Open(const std::string& path) {
  if (path.empty()) return nullptr;
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "w");
  if (log == nullptr) {
    throw std::runtime_error("telemetry log " + path + ": " + rt::ErrnoText());
  }
  return log;
}

}  // namespace

EventLog::EventLog(const std::string& path)
    : log_(Open(path)), file_(log_ ? log_->f : nullptr, path, buffer_) {}

void EventLog::Write(const char* channel, Bytes message, std::int64_t utime) {
  if (!file_.good()) {
    file_.Count(false);
    return;
  }
  lcm_eventlog_event_t event{};
  event.timestamp = utime;
  event.channellen = static_cast<std::int32_t>(std::strlen(channel));
  event.datalen = static_cast<std::int32_t>(message.size());
  event.channel = const_cast<char*>(channel);  // read only, but liblcm's struct serves reading too
  event.data = const_cast<std::uint8_t*>(message.data());
  file_.Count(lcm_eventlog_write_event(log_.get(), &event) == 0);
}

}  // namespace reed::telemetry
