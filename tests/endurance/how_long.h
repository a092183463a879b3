// How much a test of endurance does: little in every test, all of it in the long mode (tools/reed test --long).
#pragma once

#include <cstdlib>
#include <string_view>

namespace reed::test {

inline bool LongMode() {
  const char* const value = std::getenv("REED_LONG");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return value != nullptr && std::string_view(value) == "1";
}

inline long HowMany(long ordinary, long in_long_mode) { return LongMode() ? in_long_mode : ordinary; }

}  // namespace reed::test
