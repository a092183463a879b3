// From plain records to the bytes of the LCM types. RT: publishing thread only.
#pragma once

#include <cstdint>
#include <reed/event_t.hpp>
#include <reed/plant_t.hpp>
#include <reed/shape_t.hpp>
#include <reed/wire_t.hpp>
#include <span>
#include <vector>

#include "reed/plant/record/records.h"

namespace reed::plant {

inline constexpr const char* kPlantChannel = "REED_PLANT";
inline constexpr const char* kPlantEventChannel = "REED_PLANT_EVENT";
inline constexpr const char* kShapeChannel = "REED_SHAPE";
inline constexpr const char* kWireChannel = "REED_WIRE";

struct Message {
  const char* channel = nullptr;
  std::int64_t utime = 0;
  std::span<const std::uint8_t> bytes;  // valid until the next Encode
};

class MessageEncoder {
 public:
  Message Encode(const Record& record);

 private:
  template <typename T>
  Message Pack(const char* channel, const T& message);

  plant_t plant_;
  event_t event_;
  shape_t shape_;
  wire_t wire_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace reed::plant
