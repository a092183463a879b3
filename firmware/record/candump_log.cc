#include "reed/firmware/record/candump_log.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstring>
#include <stdexcept>

#include "reed/rt/errno_text.h"

namespace reed::telemetry {
namespace {

std::FILE* Open(const std::string& path) {
  if (path.empty()) return nullptr;
  std::FILE* file = std::fopen(path.c_str(), "we");
  if (file == nullptr) throw std::runtime_error("CAN log " + path + ": " + rt::ErrnoText());
  return file;
}

/// The format separates its fields by blanks, so the name may not hold any.
std::string OneWord(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
  return name.empty() ? "can" : name;
}

}  // namespace

CandumpLog::CandumpLog(const std::string& path, const std::string& interface)
    : interface_(OneWord(interface)), stream_(Open(path)), file_(stream_.get(), path, buffer_) {}

void CandumpLog::Write(const bus::Frame& frame, std::int64_t utime) {
  if (!file_.good()) {
    file_.Count(false);
    return;
  }
  constexpr char kHex[] = "0123456789ABCDEF";
  constexpr int kBitRateSwitch = 1;  // CANFD_BRS: the data phase runs at the higher rate
  const std::size_t size = std::min<std::size_t>(frame.size, frame.data.size());
  std::array<char, 129> digits;
  for (std::size_t i = 0; i < size; ++i) {
    digits[2 * i] = kHex[frame.data[i] >> 4];
    digits[2 * i + 1] = kHex[frame.data[i] & 0xF];
  }
  digits[2 * size] = '\0';
  const int written = std::fprintf(stream_.get(), "(%010" PRId64 ".%06" PRId64 ") %s %03" PRIX32 "##%d%s\n",
                                   utime / 1'000'000, utime % 1'000'000, interface_.c_str(), frame.id,
                                   kBitRateSwitch, digits.data());
  file_.Count(written > 0);
}

}  // namespace reed::telemetry
