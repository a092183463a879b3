#include "reed/firmware/tape/tape_writer.h"

#include <algorithm>

#include "reed/firmware/tape/tape_fields.h"

namespace reed::tape {
namespace {

/// Before stdio's buffer is full, so that the kernel sees whole records only.
constexpr std::size_t kFlushBytes = 512 << 10;

}  // namespace

TapeWriter::TapeWriter(const std::string& path, const Header& header)
    : joints_(header.joints),
      parameters_(header.parameters),
      buffer_(path.empty() ? nullptr : telemetry::MakeRecordBuffer()),
      stream_(telemetry::OpenRecordFile("tape", path)),
      file_(stream_.get(), path, buffer_) {
  if (!enabled()) return;
  record_.resize(sizeof(RecordHead) + kMostBytes + sizeof(std::uint32_t));
  const std::string text = ToText(header);
  if (text.size() > kMostBytes)
    throw std::runtime_error("tape " + path + ": the configuration has " + std::to_string(text.size()) +
                             " bytes; allowed: " + std::to_string(kMostBytes));
  file_.Count(std::fwrite(kMark.data(), 1, kMark.size(), stream_.get()) == kMark.size());
  Begin(Kind::kHeader);
  Append(text.data(), text.size());
  Finish();
  Flush();
}

template <typename T>
void TapeWriter::Append(const T* first, std::size_t count) {
  std::memcpy(record_.data() + used_, first, count * sizeof(T));
  used_ += count * sizeof(T);
}

void TapeWriter::Begin(Kind kind) {
  used_ = 0;
  const RecordHead head{kind, 0};
  Append(&head);
}

void TapeWriter::Finish() {
  const auto bytes = static_cast<std::uint32_t>(used_ - sizeof(RecordHead));
  std::memcpy(record_.data() + offsetof(RecordHead, bytes), &bytes, sizeof bytes);
  const std::uint32_t crc = Crc32(std::span(record_).first(used_));
  Append(&crc);
  if (pending_bytes_ + used_ > kFlushBytes) {
    file_.Flush();
    pending_bytes_ = 0;
  }
  pending_bytes_ += used_;
  file_.Count(file_.good() && std::fwrite(record_.data(), 1, used_, stream_.get()) == used_);
}

void TapeWriter::Write(const telemetry::Snapshot& s) {
  if (!enabled()) return;
  Begin(Kind::kCycle);
  Fields(s, joints_, parameters_, [this](Role, const char*, const auto* first, int count) {
    Append(first, static_cast<std::size_t>(count));
  });
  for (int i = 0; i < s.num_events; ++i) {
    const telemetry::Event& e = s.events[static_cast<std::size_t>(i)];
    const EventBytes event{e.code, e.joint, e.mode, e.force_source, static_cast<std::int8_t>(e.about_time),
                           0,      0,       e.value};
    Append(&event);
  }
  s.ForEachFrame([this](const telemetry::RecordedFrame& f) {
    const FrameBytes frame{f.offset_ns, f.frame.id, static_cast<std::uint8_t>(f.direction), f.frame.size,
                           f.frame.extended};
    Append(&frame);
    Append(f.frame.data.data(), f.frame.size);
  });
  Finish();
  ++cycles_;
}

void TapeWriter::End() {
  if (!enabled()) return;
  Begin(Kind::kEnd);
  Append(&cycles_);
  Finish();
  Flush();
}

}  // namespace reed::tape
