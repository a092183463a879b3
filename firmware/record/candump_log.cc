#include "reed/firmware/record/candump_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace reed::telemetry {
namespace {

constexpr std::int64_t kMicroseconds = 1'000'000;  // of a second
constexpr char kHex[] = "0123456789ABCDEF";
constexpr std::string_view kFlags = "##1";  // CAN FD; CANFD_BRS: the data phase runs at the higher rate
constexpr std::size_t kMostName = 64;
constexpr std::size_t kMostBytes = 256;  // of a line: two numbers, a name, 128 digits

/// At least `digits` digits, filled up with zeros. Eight lines a cycle by printf cost a twentieth of lockstep.
char* Decimal(char* to, std::int64_t value, int digits) {
  std::array<char, 20> text;
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  const auto count = end - text.data();
  for (auto i = count; i < digits; ++i) *to++ = '0';
  return std::copy(text.data(), text.data() + count, to);
}

/// The format separates its fields by blanks, so the name may not hold any.
std::string OneWord(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
  return name.empty() ? "can" : name.substr(0, kMostName);
}

}  // namespace

CandumpLog::CandumpLog(const std::string& path, const std::string& interface)
    : middle_(") " + OneWord(interface) + " "),
      stream_(OpenRecordFile("CAN log", path)),
      file_(stream_.get(), path, buffer_) {}

void CandumpLog::Write(const bus::Frame& frame, std::int64_t utime) {
  if (!file_.good()) {
    file_.Count(false);
    return;
  }
  std::array<char, kMostBytes> line;
  char* at = line.data();
  *at++ = '(';
  at = Decimal(at, utime / kMicroseconds, 10);
  *at++ = '.';
  at = Decimal(at, utime % kMicroseconds, 6);
  at = std::copy_n(middle_.data(), middle_.size(), at);
  for (int shift = frame.extended ? 28 : 8; shift >= 0; shift -= 4) *at++ = kHex[(frame.id >> shift) & 0xF];
  at = std::copy_n(kFlags.data(), kFlags.size(), at);
  const std::size_t size = std::min<std::size_t>(frame.size, frame.data.size());
  for (std::size_t i = 0; i < size; ++i) {
    *at++ = kHex[frame.data[i] >> 4];
    *at++ = kHex[frame.data[i] & 0xF];
  }
  *at++ = '\n';
  const std::size_t bytes = static_cast<std::size_t>(at - line.data());
  const bool written = std::fwrite(line.data(), 1, bytes, stream_.get()) == bytes;
  file_.Count(written);
}

}  // namespace reed::telemetry
