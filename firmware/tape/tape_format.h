// How a tape is laid out: a mark, then records of kind, length, payload and checksum, little-endian. A tape that ends
// anywhere is whole up to its last whole record. docs/replay.md describes it for other readers.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reed::tape {

static_assert(std::endian::native == std::endian::little);

inline constexpr std::array<char, 8> kMark{'R', 'E', 'E', 'D', 'T', 'A', 'P', 'E'};
/// Of the records' layout. Which values a cycle has is said by the header, so a new value is no new schema.
inline constexpr std::uint32_t kSchema = 1;

enum class Kind : std::uint32_t {
  kHeader = 1,  // text, tape_header.h
  kCycle = 2,   // the header's fields, then events and frames
  kEnd = 3,     // i64 cycles: the program ended by itself, and this many are on the tape
};

struct RecordHead {
  Kind kind;
  std::uint32_t bytes;  // of the payload, without the checksum behind it
};

/// Longer payloads are damage: a header with its configuration has a few kilobytes, a cycle five.
inline constexpr std::uint32_t kMostBytes = 1 << 20;

struct EventBytes {
  std::int32_t code, joint;
  std::int8_t mode, force_source, about_time, unused;
  std::int32_t padding;
  double value;
};
static_assert(sizeof(EventBytes) == 24);

struct FrameBytes {  // then `size` bytes
  std::int32_t offset_ns;
  std::uint32_t id;
  std::uint8_t direction, size;
  std::uint16_t extended;  // 1: identifier of 29 bits
};
static_assert(sizeof(FrameBytes) == 12);

namespace detail {
/// Row 0 is the table of one byte; row k is for a byte that k others follow.
constexpr std::array<std::array<std::uint32_t, 256>, 8> CrcTables() {
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1u) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    tables[0][i] = c;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::size_t i = 0; i < 256; ++i)
      tables[k][i] = (tables[k - 1][i] >> 8) ^ tables[0][tables[k - 1][i] & 0xFFu];
  return tables;
}
inline constexpr auto kCrc = CrcTables();
}  // namespace detail

/// CRC-32 of IEEE 802.3, as zlib's crc32: eight bytes at a time.
constexpr std::uint32_t Crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0) noexcept {
  const auto& t = detail::kCrc;
  std::uint32_t c = ~before;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    const std::uint8_t* b = bytes.data() + i;
    c ^= static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8 |
         static_cast<std::uint32_t>(b[2]) << 16 | static_cast<std::uint32_t>(b[3]) << 24;
    c = t[7][c & 0xFFu] ^ t[6][(c >> 8) & 0xFFu] ^ t[5][(c >> 16) & 0xFFu] ^ t[4][c >> 24] ^ t[3][b[4]] ^
        t[2][b[5]] ^ t[1][b[6]] ^ t[0][b[7]];
  }
  for (; i < bytes.size(); ++i) c = t[0][(c ^ bytes[i]) & 0xFFu] ^ (c >> 8);
  return ~c;
}

}  // namespace reed::tape
