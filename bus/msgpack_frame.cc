#include "bus/msgpack_frame.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
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
  std::optional<std::uint64_t> Map() noexcept {
    const auto tag = BigEndian(1);
    if (!tag) return std::nullopt;
    if ((*tag & 0xF0U) == kFixMap) return *tag & 0xFU;
    if (*tag == kMap16 || *tag == kMap32) return BigEndian(*tag == kMap16 ? 2 : 4);
    return std::nullopt;
  }

  std::optional<Value> Next() noexcept {
    using Kind = Value::Kind;
    const auto first = BigEndian(1);
    if (!first) return std::nullopt;
    const std::uint64_t tag = *first;
    if (tag < kFixMap) return Value{Kind::kUnsigned, tag, {}};
    if ((tag & 0xE0U) == kFixStr) return Sized(Kind::kString, tag & 0x1FU);
    if (tag == kNil) return Value{};
    if (tag == kFalse || tag == kTrue) return Value{Kind::kBool, tag - kFalse, {}};
    if (tag >= kBin8 && tag <= kBin32) return Sized(Kind::kBinary, BigEndian(1U << (tag - kBin8)));
    if (tag == kFloat32 || tag == kFloat64) return Number(Kind::kFloat, tag == kFloat32 ? 4 : 8);
    if (tag >= kUint8 && tag <= kUint64) return Number(Kind::kUnsigned, 1U << (tag - kUint8));
    if (tag >= kInt8 && tag <= kInt64) return Signed(1U << (tag - kInt8));
    if (tag >= kStr8 && tag <= kStr32) return Sized(Kind::kString, BigEndian(1U << (tag - kStr8)));
    if (tag >= 0xE0U) return Value{Kind::kNegative, tag, {}};
    return std::nullopt;  // arrays, maps and extensions have no place in a frame
  }

  bool AtEnd() const noexcept { return in_.empty(); }

 private:
  std::optional<std::uint64_t> BigEndian(std::size_t width) noexcept {
    if (in_.size() < width) return std::nullopt;
    std::uint64_t value = 0;
    for (const std::uint8_t byte : in_.first(width)) value = value << 8 | byte;
    in_ = in_.subspan(width);
    return value;
  }
  std::optional<Value> Number(Value::Kind kind, std::size_t width) noexcept {
    const auto number = BigEndian(width);
    if (!number) return std::nullopt;
    return Value{kind, *number, {}};
  }
  std::optional<Value> Signed(std::size_t width) noexcept {
    const auto value = Number(Value::Kind::kUnsigned, width);
    if (value && (value->number >> (8 * width - 1)) != 0)
      return Value{Value::Kind::kNegative, value->number, {}};
    return value;
  }
  std::optional<Value> Sized(Value::Kind kind, std::optional<std::uint64_t> size) noexcept {
    if (!size || in_.size() < *size) return std::nullopt;
    const Value value{kind, 0, in_.first(*size)};
    in_ = in_.subspan(*size);
    return value;
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

std::optional<Fields> ReadFields(Bytes bytes) noexcept {
  Reader reader(bytes);
  const auto pairs = reader.Map();
  if (!pairs) return std::nullopt;
  Fields fields;
  for (std::uint64_t i = 0; i < *pairs; ++i) {  // ends at the latest with the bytes
    const auto key = reader.Next();
    if (!key || key->kind != Value::Kind::kString) return std::nullopt;
    const auto value = reader.Next();
    if (!value) return std::nullopt;
    if (Value* field = Find(fields, Text(key->bytes))) *field = *value;
  }
  if (!reader.AtEnd()) return std::nullopt;
  return fields;
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
  w.Byte(kUint16);
  w.Byte(frame.id >> 8 & 0x07U);
  w.Byte(frame.id & 0xFFU);
  w.Bool("is_extended_id", false);
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
  const auto fields = ReadFields(bytes);
  if (!fields) return Incoming::kMalformed;
  if (fields->error.IsTrue()) return Incoming::kErrorFrame;
  const bool data_frame =
      fields->fd.IsTrue() && !fields->extended.IsTrue() && !fields->remote.IsTrue() &&
      fields->id.kind == Value::Kind::kUnsigned && fields->id.number <= 0x7FFU &&
      fields->data.kind == Value::Kind::kBinary && IsCanFdSize(fields->data.bytes.size()) &&
      fields->dlc.kind == Value::Kind::kUnsigned && fields->dlc.number == fields->data.bytes.size();
  if (!data_frame) return Incoming::kMalformed;
  out = Frame{};
  out.id = static_cast<std::uint32_t>(fields->id.number);
  out.size = static_cast<std::uint8_t>(fields->data.bytes.size());
  std::copy(fields->data.bytes.begin(), fields->data.bytes.end(), out.data.begin());
  return Incoming::kFrame;
}

}  // namespace reed::bus
