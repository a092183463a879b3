#include "firmware/telemetry/record_file.h"

#include <stdio_ext.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace reed::telemetry {
namespace {
constexpr std::size_t kBufferBytes = std::size_t{1} << 20;  // about 0.5 s of a 1 kHz run
}

RecordFile::RecordFile(std::FILE* file, const std::string& path) : file_(file) {
  if (file_ == nullptr) return;
  report_.name = path;
  std::setvbuf(file_, nullptr, _IOFBF, kBufferBytes);
}

void RecordFile::Count(bool taken) {
  if (file_ == nullptr) return;
  if (taken) {
    ++pending_;
    return;
  }
  ++report_.lost;
  if (good()) Fail();
}

void RecordFile::Flush() {
  if (!good() || pending_ == 0) return;
  if (std::fflush(file_) != 0) {
    Fail();
    return;
  }
  report_.written += pending_;
  pending_ = 0;
  complete_bytes_ = ftello(file_);
}

void RecordFile::Fail() {
  report_.problem = report_.name + ": " + std::strerror(errno) + "; the file ends there";
  report_.lost += pending_;
  pending_ = 0;
  __fpurge(file_);  // or closing would append half a record
  // Fails on what is no regular file, which then has nothing to cut back.
  if (complete_bytes_ >= 0 && ftruncate(fileno(file_), complete_bytes_) != 0) errno = 0;
}

}  // namespace reed::telemetry
