// Frames that no sound sender would send, and some that one would: the same sequence for the same seed.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

#include "reed/bus/codec/messages.h"

namespace reed::test {

class FrameMutants {
 public:
  explicit FrameMutants(std::uint64_t seed) : random_(seed) {}

  bus::Frame Next() {
    switch (Below(8)) {
      case 0:
        return last_ = Noise();
      case 1:
        return last_ = NoiseUnderAKnownIdentifier();
      case 2:
        return last_ = ForgedContent();
      case 3:
        return last_ = Damaged(Sound());
      case 4:
        return last_ = OfAnotherShape(Sound());
      case 5:
        return last_;  // once more
      default:
        return last_ = Sound();
    }
  }

  std::uint64_t Below(std::uint64_t end) { return random_() % end; }

  /// Cycle of the frames that look sound; they are also late and early.
  std::uint32_t cycle = 0;

 private:
  static constexpr std::size_t kKinds = bus::layout::kFrames.size();

  /// Any bits: NaN, infinity and tiny numbers are among them.
  double AnyNumber() {
    if (Below(4) == 0) return std::bit_cast<double>(random_());
    return (static_cast<double>(Below(2'000'001)) - 1e6) * (Below(2) == 0 ? 1e-6 : 1e-2);
  }

  void Fill(bus::Frame& frame) {
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random_());
  }

  bus::Frame Noise() {
    bus::Frame frame;
    frame.extended = Below(4) == 0;
    frame.id = static_cast<std::uint32_t>(Below(frame.extended ? 1U << 29U : 1U << 11U));
    frame.size = static_cast<std::uint8_t>(Below(65));
    Fill(frame);
    return frame;
  }

  bus::Frame NoiseUnderAKnownIdentifier() {
    const bus::FrameLayout& layout = bus::layout::kFrames[Below(kKinds)];
    bus::Frame frame;
    frame.id = layout.id;
    frame.size = layout.size;
    Fill(frame);
    return frame;
  }

  /// Any content under a right checksum and a counter that follows, as a broken sender's own.
  bus::Frame ForgedContent() {
    const std::size_t kind = Below(kKinds);
    const bus::FrameLayout& layout = bus::layout::kFrames[kind];
    bus::Frame frame;
    frame.id = layout.id;
    frame.size = layout.size;
    Fill(frame);
    if (frame.id == bus::layout::kSync.id && Below(64) != 0) frame.data[3] = bus::layout::kLayoutId;
    senders_[kind].Protect(std::span(frame.data).first(layout.size), layout.data_id);
    return frame;
  }

  bus::Frame Sound() {
    const auto near = static_cast<std::uint32_t>(cycle + Below(8) - 4);
    const std::uint32_t number = Below(4) == 0 ? near : cycle;
    switch (Below(8)) {
      case 0:
        return encoder_.Sync({number, bus::layout::kLayoutId});
      case 1: {
        bus::CommandMessage command{number, static_cast<bus::DriveRequest>(Below(3)), {}};
        for (double& torque : command.torque_Nm) torque = AnyNumber();
        return encoder_.Command(command);
      }
      case 2:
        return encoder_.Wrench({number,
                                {AnyNumber(), AnyNumber(), AnyNumber()},
                                {AnyNumber(), AnyNumber(), AnyNumber()},
                                Below(2) == 0});
      default:
        return encoder_.JointState(
            static_cast<int>(Below(kMaxJoints)),
            {AnyNumber(), AnyNumber(), AnyNumber(), static_cast<bus::DriveState>(Below(5)),
             static_cast<std::uint8_t>(number & 0xFU)});
    }
  }

  bus::Frame Damaged(bus::Frame frame) {
    for (std::uint64_t bits = 1 + Below(3); bits > 0; --bits) {
      const std::uint64_t bit = Below(8 * static_cast<std::uint64_t>(frame.size));
      frame.data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    }
    return frame;
  }

  bus::Frame OfAnotherShape(bus::Frame frame) {
    if (Below(2) == 0) {
      frame.size = static_cast<std::uint8_t>(Below(65));
    } else if (Below(2) == 0) {
      frame.extended = true;
    } else {
      frame.id ^= 1U << Below(11);
    }
    return frame;
  }

  std::mt19937_64 random_;
  bus::FrameEncoder encoder_;
  std::array<bus::E2eSender, kKinds> senders_;
  bus::Frame last_;
};

}  // namespace reed::test
