// Byte strings here were written by Python's msgpack for python-can messages; the live comparison is
// test_udp_bus.py.
#include "reed/bus/transport/msgpack_frame.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace reed::bus {
namespace {

using Bytes = std::vector<std::uint8_t>;

Frame RandomFrame(std::mt19937& random, std::uint8_t size) {
  Frame frame;
  frame.id = static_cast<std::uint32_t>(random() & 0x7FFU);
  frame.size = size;
  for (std::size_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(random());
  return frame;
}

Bytes Pack(const Frame& frame) {
  std::array<std::uint8_t, kMaxPackedFrame> out{};
  const std::size_t size = PackFrame(frame, 1.5e9, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size)};
}

/// A map built by hand, so that each value can take any form that msgpack allows.
class MapBuilder {
 public:
  MapBuilder& Set(const std::string& key, const Bytes& value) {
    for (auto& [name, old] : pairs_) {
      if (name == key) {
        old = value;
        return *this;
      }
    }
    pairs_.emplace_back(key, value);
    return *this;
  }
  MapBuilder& Without(const std::string& key) {
    std::erase_if(pairs_, [&](const auto& pair) { return pair.first == key; });
    return *this;
  }
  Bytes Build() const {
    Bytes out{static_cast<std::uint8_t>(0x80U | pairs_.size())};
    for (const auto& [key, value] : pairs_) {
      out.push_back(static_cast<std::uint8_t>(0xA0U | key.size()));
      out.insert(out.end(), key.begin(), key.end());
      out.insert(out.end(), value.begin(), value.end());
    }
    return out;
  }

 private:
  std::vector<std::pair<std::string, Bytes>> pairs_{{"timestamp", {0xCB, 0, 0, 0, 0, 0, 0, 0, 0}},
                                                    {"arbitration_id", {0xCD, 0x01, 0x40}},
                                                    {"is_extended_id", {0xC2}},
                                                    {"is_remote_frame", {0xC2}},
                                                    {"is_error_frame", {0xC2}},
                                                    {"channel", {0xC0}},
                                                    {"dlc", {0x03}},
                                                    {"data", {0xC4, 3, 9, 8, 7}},
                                                    {"is_fd", {0xC3}},
                                                    {"bitrate_switch", {0xC3}},
                                                    {"error_state_indicator", {0xC2}}};
};

Incoming Read(const Bytes& bytes) {
  Frame frame;
  return UnpackFrame(bytes, frame);
}

TEST(MsgpackFrame, EveryCanFdSizeSurvives) {
  std::mt19937 random(3);
  for (const int size : {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64}) {
    const Frame sent = RandomFrame(random, static_cast<std::uint8_t>(size));
    Frame got;
    ASSERT_EQ(UnpackFrame(Pack(sent), got), Incoming::kFrame);
    EXPECT_EQ(got.id, sent.id);
    EXPECT_EQ(got.size, sent.size);
    EXPECT_EQ(got.data, sent.data);
  }
}

TEST(MsgpackFrame, LongestFrameFitsItsBuffer) {
  std::mt19937 random(4);
  EXPECT_LE(Pack(RandomFrame(random, 64)).size(), kMaxPackedFrame);
}

TEST(MsgpackFrame, EveryIntegerWidthIsAccepted) {
  const std::vector<Bytes> widths_of_0x20{{0x20},
                                          {0xCC, 0x20},
                                          {0xCD, 0, 0x20},
                                          {0xCE, 0, 0, 0, 0x20},
                                          {0xCF, 0, 0, 0, 0, 0, 0, 0, 0x20},
                                          {0xD0, 0x20},
                                          {0xD1, 0, 0x20},
                                          {0xD2, 0, 0, 0, 0x20},
                                          {0xD3, 0, 0, 0, 0, 0, 0, 0, 0x20}};
  for (const Bytes& id : widths_of_0x20) {
    for (Bytes dlc : widths_of_0x20) {
      dlc.back() = 3;
      Frame frame;
      ASSERT_EQ(UnpackFrame(MapBuilder().Set("arbitration_id", id).Set("dlc", dlc).Build(), frame),
                Incoming::kFrame);
      EXPECT_EQ(frame.id, 0x20U);
      EXPECT_EQ(frame.size, 3);
      EXPECT_EQ(frame.data[2], 7);
    }
  }
}

TEST(MsgpackFrame, OtherWidthsOfStringsBinariesFloatsAndMapsAreAccepted) {
  EXPECT_EQ(Read(MapBuilder().Set("data", {0xC5, 0, 3, 9, 8, 7}).Build()), Incoming::kFrame);
  EXPECT_EQ(Read(MapBuilder().Set("data", {0xC6, 0, 0, 0, 3, 9, 8, 7}).Build()), Incoming::kFrame);
  EXPECT_EQ(Read(MapBuilder().Set("timestamp", {0xCA, 0, 0, 0, 0}).Build()), Incoming::kFrame);
  EXPECT_EQ(Read(MapBuilder().Set("timestamp", {0xD0, 0xFF}).Build()), Incoming::kFrame);
  EXPECT_EQ(Read(MapBuilder().Set("channel", {0xA5, 'v', 'c', 'a', 'n', '0'}).Build()), Incoming::kFrame);
  EXPECT_EQ(Read(MapBuilder().Set("channel", {0xD9, 1, 'v'}).Build()), Incoming::kFrame);
  Bytes wide_map = MapBuilder().Build();
  wide_map[0] = 0xDE;
  wide_map.insert(wide_map.begin() + 1, {0, 11});
  EXPECT_EQ(Read(wide_map), Incoming::kFrame);
}

TEST(MsgpackFrame, IdentifiersOf29BitsArriveAsTheyWere) {
  Frame frame;
  frame.size = 8;
  frame.extended = true;
  for (const std::uint32_t id : {0U, 0x7FFU, 0x8001U, 0x1FFFFFFFU}) {
    frame.id = id;
    Frame read;
    ASSERT_EQ(UnpackFrame(Pack(frame), read), Incoming::kFrame);
    EXPECT_TRUE(read.extended);
    EXPECT_EQ(read.id, id);
  }
  EXPECT_EQ(
      Read(MapBuilder().Set("is_extended_id", {0xC3}).Set("arbitration_id", {0xCE, 0x20, 0, 0, 0}).Build()),
      Incoming::kMalformed)
      << "30 bits";
}

TEST(MsgpackFrame, WhatIsNoCanFdDataFrameIsMalformed) {
  ASSERT_EQ(Read(MapBuilder().Build()), Incoming::kFrame);
  EXPECT_EQ(Read(MapBuilder().Set("is_fd", {0xC2}).Build()), Incoming::kMalformed) << "classic";
  EXPECT_EQ(Read(MapBuilder().Set("is_remote_frame", {0xC3}).Build()), Incoming::kMalformed) << "remote";
  EXPECT_EQ(Read(MapBuilder().Set("arbitration_id", {0xCD, 0x08, 0x00}).Build()), Incoming::kMalformed)
      << "0x800";
  EXPECT_EQ(Read(MapBuilder().Set("arbitration_id", {0xFF}).Build()), Incoming::kMalformed) << "negative";
  EXPECT_EQ(Read(MapBuilder().Set("arbitration_id", {0xD1, 0xFF, 0xFF}).Build()), Incoming::kMalformed)
      << "negative";
  EXPECT_EQ(Read(MapBuilder().Set("dlc", {0x04}).Build()), Incoming::kMalformed) << "dlc is not the length";
  EXPECT_EQ(Read(MapBuilder().Set("data", {0xA3, 9, 8, 7}).Build()), Incoming::kMalformed)
      << "data is a string";
  EXPECT_EQ(Read(MapBuilder().Set("data", {0xC4, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9}).Set("dlc", {9}).Build()),
            Incoming::kMalformed)
      << "no CAN FD size";
  for (const char* key : {"arbitration_id", "dlc", "data", "is_fd"}) {
    EXPECT_EQ(Read(MapBuilder().Without(key).Build()), Incoming::kMalformed) << key;
  }
}

TEST(MsgpackFrame, ErrorFrameIsToldApart) {
  EXPECT_EQ(Read(MapBuilder().Set("is_error_frame", {0xC3}).Build()), Incoming::kErrorFrame);
}

TEST(MsgpackFrame, EveryTruncationIsMalformed) {
  std::mt19937 random(5);
  const Bytes whole = Pack(RandomFrame(random, 24));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_EQ(Read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
              Incoming::kMalformed);
  }
  Bytes longer = whole;
  longer.push_back(0);
  EXPECT_EQ(Read(longer), Incoming::kMalformed);
}

TEST(MsgpackFrame, DamageNeverYieldsAFrameThatCanFdCouldNotCarry) {
  std::mt19937 random(6);
  const Bytes whole = Pack(RandomFrame(random, 48));
  int frames = 0, malformed = 0;
  for (int i = 0; i < 200000; ++i) {
    Bytes bytes = whole;
    for (int n = 0; n < 1 + i % 4; ++n) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    Frame frame;
    const Incoming got = UnpackFrame(bytes, frame);
    if (got == Incoming::kFrame) {
      ++frames;
      ASSERT_LE(frame.id, frame.extended ? 0x1FFFFFFFU : 0x7FFU);
      ASSERT_TRUE(IsCanFdSize(frame.size));
    }
    malformed += got == Incoming::kMalformed ? 1 : 0;
  }
  EXPECT_GT(frames, 1000);
  EXPECT_GT(malformed, 1000);
}

}  // namespace
}  // namespace reed::bus
