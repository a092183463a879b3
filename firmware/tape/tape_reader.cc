#include "reed/firmware/tape/tape_reader.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "reed/firmware/tape/tape_fields.h"
#include "reed/rt/errno_text.h"

namespace reed::tape {
namespace {

std::size_t BytesOf(const Field& field) {
  return static_cast<std::size_t>(field.type.back() - '0') * static_cast<std::size_t>(field.count);
}

}  // namespace

TapeReader::TapeReader(const std::string& path) : file_(std::fopen(path.c_str(), "re")) {
  if (!file_) throw std::runtime_error(path + ": " + rt::ErrnoText());
  std::array<char, kMark.size()> mark{};
  if (std::fread(mark.data(), 1, mark.size(), file_.get()) != mark.size() || mark != kMark)
    throw std::runtime_error(path + ": is no tape; allowed: the tape.reed of a run folder");
  payload_.reserve(kMostBytes);
  if (!ReadRecord() || head_.kind != Kind::kHeader)
    throw std::runtime_error(path + ": its header is damaged; nothing of it can be replayed");
  try {
    header_ = FromText({payload_.begin(), payload_.end()});
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  if (header_.schema != kSchema)
    throw std::runtime_error(path + ": tape schema " + std::to_string(header_.schema) +
                             ", this program reads " + std::to_string(kSchema) +
                             "; replay it with the Reed that wrote it, commit " + header_.commit);
  if (header_.joints < 1 || header_.joints > kMaxJoints || header_.parameters < 0 ||
      header_.parameters > kMaxParameters)
    throw std::runtime_error(path + ": its header is damaged; nothing of it can be replayed");
  FindInputs(path);
}

void TapeReader::FindInputs(const std::string& path) {
  telemetry::Snapshot any;
  for (const Field& field : header_.fields) fixed_bytes_ += BytesOf(field);
  Fields(any, header_.joints, header_.parameters,
         [&](Role role, const char* name, const auto* first, int count) {
           if (role != Role::kInput) return;
           using T = std::remove_cvref_t<decltype(*first)>;
           std::size_t at = 0;
           for (const Field& field : header_.fields) {
             if (field.name == name && field.type == TypeName<T>() && field.count == count) {
               input_at_.push_back(at);
               return;
             }
             at += BytesOf(field);
           }
           throw std::runtime_error(path + ": has no value " + name +
                                    ", which this program needs; replay it with the Reed " +
                                    "that wrote it, commit " + header_.commit);
         });
}

bool TapeReader::ReadRecord() noexcept {
  if (std::fread(&head_, sizeof head_, 1, file_.get()) != 1 || head_.bytes > kMostBytes) return false;
  payload_.resize(head_.bytes);
  std::uint32_t crc = 0;
  if (std::fread(payload_.data(), 1, head_.bytes, file_.get()) != head_.bytes ||
      std::fread(&crc, sizeof crc, 1, file_.get()) != 1)
    return false;
  std::array<std::uint8_t, sizeof head_> head;
  std::memcpy(head.data(), &head_, sizeof head_);
  return crc == Crc32(payload_, Crc32(head));
}

bool TapeReader::Next(telemetry::Snapshot& s) noexcept {
  if (complete_ || !ReadRecord()) return false;
  if (head_.kind == Kind::kEnd) complete_ = true;
  if (head_.kind != Kind::kCycle || payload_.size() < fixed_bytes_) return false;
  std::size_t next = 0;
  Fields(s, header_.joints, header_.parameters, [&](Role role, const char*, auto* first, int count) {
    if (role == Role::kInput)
      std::memcpy(first, payload_.data() + input_at_[next++],
                  sizeof *first * static_cast<std::size_t>(count));
  });
  if (s.num_events < 0 || s.num_frames < 0) return false;
  const std::int32_t frames = s.num_frames, omitted = s.frames_omitted;
  std::size_t at = fixed_bytes_ + static_cast<std::size_t>(s.num_events) * sizeof(EventBytes);
  s.ClearLists();
  s.frames_omitted = omitted;
  for (std::int32_t i = 0; i < frames; ++i) {
    FrameBytes head;
    if (at + sizeof head > payload_.size()) return false;
    std::memcpy(&head, payload_.data() + at, sizeof head);
    bus::Frame frame{head.id, head.size, {}, head.extended != 0};
    at += sizeof head;
    if (head.size > frame.data.size() || at + head.size > payload_.size()) return false;
    std::memcpy(frame.data.data(), payload_.data() + at, head.size);
    s.AddFrame(frame, static_cast<telemetry::Direction>(head.direction), head.offset_ns);
    at += head.size;
  }
  return true;
}

}  // namespace reed::tape
