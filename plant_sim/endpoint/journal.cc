#include "reed/plant/endpoint/journal.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace reed::plant {

void Journal::Note(PlantEvent code, bus::DriveState state, double value, const char* format, ...) noexcept {
  EventRecord event;
  event.cycle = cycle_;
  event.utime = utime_;
  event.mode = std::min(static_cast<std::int8_t>(state), static_cast<std::int8_t>(3));
  event.code = code;
  event.value = value;
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(event.text.data(), event.text.size(), format, arguments);
  va_end(arguments);
  recorder_.Put(event);
}

}  // namespace reed::plant
