#include "reed/bus/transport/msgpack_frame.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

namespace reed::bus {
namespace {

using Bytes = std::span<const std::uint8_t>;

// First bytes of msgpack values.
enum : std::uint8_t {
  kFixMap = 0x80,
  kFixStr = 0xA0,
  kNil = 0xC0,
  kFalse = 0xC2,
  kTrue = 0xC3,
  kBin8 = 0xC4,
  kBin32 = 0xC6,
  kFloat32 = 0xCA,
  kFloat64 = 0xCB,
  kUint8 = 0xCC,
  kUint16 = 0xCD,
  kUint32 = 0xCE,
  kUint64 = 0xCF,
  kInt8 = 0xD0,
  kInt64 = 0xD3,
  kStr8 = 0xD9,
  kStr32 = 0xDB,
  kMap16 = 0xDE,
  kMap32 = 0xDF,
};

class Writer {
 public:
  explicit Writer(std::span<std::uint8_t, kMaxPackedFrame> out) noexcept : out_(out) {}
  void Byte(unsigned value) noexcept { out_[size_++] = static_cast<std::uint8_t>(value); }
  void Raw(const void* bytes, std::size_t count) noexcept {
    std::memcpy(&out_[size_], bytes, count);
    size_ += count;
  }
  void Key(std::string_view name) noexcept {
    Byte(kFixStr | static_cast<unsigned>(name.size()));
    Raw(name.data(), name.size());
  }
  void Bool(std::string_view name, bool value) noexcept {
    Key(name);
    Byte(value ? kTrue : kFalse);
  }
  std::size_t size() const noexcept { return size_; }

 private:
  std::span<std::uint8_t, kMaxPackedFrame> out_;
  std::size_t size_ = 0;
};

/// One msgpack value. Numbers of every kind are in `number`, strings and binaries in `bytes`.
struct Value {
  enum class Kind : std::uint8_t {
    kNil,
    kBool,
    kUnsigned,
    kNegative,
    kFloat,
    kString,
    kBinary
  } kind = Kind::kNil;
  std::uint64_t number = 0;
  Bytes bytes;
  bool IsTrue() const noexcept { return kind == Kind::kBool && number == 1; }
};

class Reader {
 public:
  explicit Reader(Bytes in) noexcept : in_(in) {}

  /// Number of pairs of a map of any width.
  bool Map(std::uint64_t& pairs) noexcept {
    std::uint64_t tag = 0;
    if (!BigEndian(1, tag)) return false;
    if ((tag & 0xF0U) == kFixMap) {
      pairs = tag & 0xFU;
      return true;
    }
    return (tag == kMap16 || tag == kMap32) && BigEndian(tag == kMap16 ? 2 : 4, pairs);
  }

  /// False at the end of the bytes and for arrays, maps and extensions, which have no place in a frame.
  bool Next(Value& out) noexcept {
    using Kind = Value::Kind;
    std::uint64_t tag = 0;
    if (!BigEndian(1, tag)) return false;
    out.number = tag;
    if (tag < kFixMap) return Is(out, Kind::kUnsigned);
    if ((tag & 0xE0U) == kFixStr) return Sized(out, Kind::kString, tag & 0x1FU);
    if (tag == kNil) return Is(out, Kind::kNil);
    if (tag == kFalse || tag == kTrue) {
      out.number = tag - kFalse;
      return Is(out, Kind::kBool);
    }
    if (tag >= kBin8 && tag <= kBin32) return Prefixed(out, Kind::kBinary, 1U << (tag - kBin8));
    if (tag == kFloat32 || tag == kFloat64) return Number(out, Kind::kFloat, tag == kFloat32 ? 4 : 8);
    if (tag >= kUint8 && tag <= kUint64) return Number(out, Kind::kUnsigned, 1U << (tag - kUint8));
    if (tag >= kInt8 && tag <= kInt64) return Signed(out, 1U << (tag - kInt8));
    if (tag >= kStr8 && tag <= kStr32) return Prefixed(out, Kind::kString, 1U << (tag - kStr8));
    return tag >= 0xE0U && Is(out, Kind::kNegative);
  }

  bool AtEnd() const noexcept { return in_.empty(); }

 private:
  bool BigEndian(std::size_t width, std::uint64_t& value) noexcept {
    if (in_.size() < width) return false;
    value = 0;
    for (std::size_t i = 0; i < width; ++i) value = value << 8 | in_[i];
    in_ = in_.subspan(width);
    return true;
  }
  static bool Is(Value& out, Value::Kind kind) noexcept {
    out.kind = kind;
    return true;
  }
  bool Number(Value& out, Value::Kind kind, std::size_t width) noexcept {
    out.kind = kind;
    return BigEndian(width, out.number);
  }
  bool Signed(Value& out, std::size_t width) noexcept {
    const bool negative = !in_.empty() && in_[0] >= 0x80;
    return Number(out, negative ? Value::Kind::kNegative : Value::Kind::kUnsigned, width);
  }
  bool Sized(Value& out, Value::Kind kind, std::uint64_t size) noexcept {
    if (in_.size() < size) return false;
    out.kind = kind;
    out.bytes = in_.first(size);
    in_ = in_.subspan(size);
    return true;
  }
  bool Prefixed(Value& out, Value::Kind kind, std::size_t width) noexcept {
    std::uint64_t size = 0;
    return BigEndian(width, size) && Sized(out, kind, size);
  }

  Bytes in_;
};

std::string_view Text(Bytes bytes) noexcept {
  return {std::bit_cast<const char*>(bytes.data()), bytes.size()};
}

/// The keys that decide whether and what a frame is; the rest (timestamp, channel, bit rate) is only skipped.
struct Fields {
  Value id, extended, remote, error, dlc, data, fd;
};

Value* Find(Fields& fields, std::string_view key) noexcept {
  if (key == "arbitration_id") return &fields.id;
  if (key == "is_extended_id") return &fields.extended;
  if (key == "is_remote_frame") return &fields.remote;
  if (key == "is_error_frame") return &fields.error;
  if (key == "dlc") return &fields.dlc;
  if (key == "data") return &fields.data;
  if (key == "is_fd") return &fields.fd;
  return nullptr;
}

bool ReadFields(Bytes bytes, Fields& fields) noexcept {
  Reader reader(bytes);
  std::uint64_t pairs = 0;
  if (!reader.Map(pairs)) return false;
  Value key, skipped;
  for (std::uint64_t i = 0; i < pairs; ++i) {  // ends at the latest with the bytes
    if (!reader.Next(key) || key.kind != Value::Kind::kString) return false;
    Value* field = Find(fields, Text(key.bytes));
    if (!reader.Next(field != nullptr ? *field : skipped)) return false;
  }
  return reader.AtEnd();
}

}  // namespace

std::size_t PackFrame(const Frame& frame, double timestamp_s,
                      std::span<std::uint8_t, kMaxPackedFrame> out) noexcept {
  Writer w(out);
  w.Byte(kFixMap | 11U);
  w.Key("timestamp");
  w.Byte(kFloat64);
  const auto bits = std::bit_cast<std::uint64_t>(timestamp_s);
  for (int shift = 56; shift >= 0; shift -= 8) w.Byte(static_cast<unsigned>(bits >> shift & 0xFFU));
  w.Key("arbitration_id");
  w.Byte(frame.extended ? kUint32 : kUint16);
  for (int shift = frame.extended ? 24 : 8; shift >= 0; shift -= 8) w.Byte(frame.id >> shift & 0xFFU);
  w.Bool("is_extended_id", frame.extended);
  w.Bool("is_remote_frame", false);
  w.Bool("is_error_frame", false);
  w.Key("channel");
  w.Byte(kNil);
  w.Key("dlc");
  w.Byte(frame.size);
  w.Key("data");
  w.Byte(kBin8);
  w.Byte(frame.size);
  w.Raw(frame.data.data(), frame.size);
  w.Bool("is_fd", true);
  w.Bool("bitrate_switch", true);
  w.Bool("error_state_indicator", false);
  return w.size();
}

Incoming UnpackFrame(std::span<const std::uint8_t> bytes, Frame& out) noexcept {
  Fields f;
  if (!ReadFields(bytes, f)) return Incoming::kMalformed;
  if (f.error.IsTrue()) return Incoming::kErrorFrame;
  const Bytes data = f.data.bytes;
  const bool data_frame = f.fd.IsTrue() && !f.remote.IsTrue() && f.id.kind == Value::Kind::kUnsigned &&
                          f.id.number <= (f.extended.IsTrue() ? 0x1FFFFFFFU : 0x7FFU) &&
                          f.data.kind == Value::Kind::kBinary && IsCanFdSize(data.size()) &&
                          f.dlc.kind == Value::Kind::kUnsigned && f.dlc.number == data.size();
  if (!data_frame) return Incoming::kMalformed;
  out = Frame{};
  out.id = static_cast<std::uint32_t>(f.id.number);
  out.extended = f.extended.IsTrue();
  out.size = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), out.data.begin());
  return Incoming::kFrame;
}

}  // namespace reed::bus
