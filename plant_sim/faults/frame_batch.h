// Frames on their way through the faults, and frames that are held back. Fixed size. RT: safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reed/bus/frame/frame.h"

namespace reed::plant {

/// What finds no room is lost, as on a wire.
class FrameBatch {
 public:
  static constexpr std::size_t kCapacity = 192;

  void Clear() noexcept { size_ = 0; }
  void Add(const bus::Frame& frame) noexcept {
    if (size_ < kCapacity) frames_[size_++] = frame;
  }
  void Add(std::span<const bus::Frame> frames) noexcept {
    for (const bus::Frame& frame : frames) Add(frame);
  }
  /// Takes out what `lost` says true to.
  template <typename Lost>
  void RemoveIf(Lost lost) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i)
      if (!lost(frames_[i])) frames_[kept++] = frames_[i];
    size_ = kept;
  }
  bus::Frame* begin() noexcept { return frames_.data(); }
  bus::Frame* end() noexcept { return frames_.data() + size_; }
  std::size_t size() const noexcept { return size_; }
  std::span<const bus::Frame> frames() const noexcept { return std::span(frames_).first(size_); }

 private:
  std::array<bus::Frame, kCapacity> frames_;
  std::size_t size_ = 0;
};

/// Frames that come later.
class HeldFrames {
 public:
  void Hold(const bus::Frame& frame, std::int64_t until_cycle) noexcept {
    if (size_ < held_.size()) held_[size_++] = {frame, until_cycle};
  }
  /// Adds to `out` what is due, in order.
  void Release(std::int64_t cycle, FrameBatch& out) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (held_[i].until_cycle <= cycle)
        out.Add(held_[i].frame);
      else
        held_[kept++] = held_[i];
    }
    size_ = kept;
  }

 private:
  struct Held {
    bus::Frame frame;
    std::int64_t until_cycle = 0;
  };
  std::array<Held, 512> held_;
  std::size_t size_ = 0;
};

}  // namespace reed::plant
