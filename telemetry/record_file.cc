#include "reed/telemetry/record_file.h"

#include <stdio_ext.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "reed/rt/errno_text.h"

namespace reed::telemetry {
namespace {
/// So many records always fit the buffer, so stdio never writes on its own and the kernel sees whole records
/// only.
constexpr std::int64_t kFlushRecords = 512;
constexpr std::size_t kBufferBytes = kFlushRecords * 2048;
}  // namespace

RecordBuffer MakeRecordBuffer() { return std::make_unique_for_overwrite<char[]>(kBufferBytes); }

FileHandle OpenRecordFile(const std::string& what, const std::string& path) {
  if (path.empty()) return nullptr;
  FileHandle file(std::fopen(path.c_str(), "we"));
  if (file == nullptr) throw std::runtime_error(what + " " + path + ": " + rt::ErrnoText());
  return file;
}

RecordFile::RecordFile(std::FILE* file, const std::string& path, const RecordBuffer& buffer) : file_(file) {
  if (file_ == nullptr) return;
  report_.name = path;
  std::setvbuf(file_, buffer.get(), _IOFBF, kBufferBytes);  // without a buffer the size counts for nothing
}

void RecordFile::Count(bool taken) {
  if (file_ == nullptr) return;
  if (taken) {
    if (++pending_ >= kFlushRecords) Flush();
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
  report_.problem = report_.name + ": " + rt::ErrnoText() + "; the file ends there";
  report_.lost += pending_;
  pending_ = 0;
  __fpurge(file_);  // or closing would append half a record
  // Fails on what is no regular file, which then has nothing to cut back.
  if (complete_bytes_ >= 0 && ftruncate(fileno(file_), complete_bytes_) != 0) errno = 0;
}

}  // namespace reed::telemetry
