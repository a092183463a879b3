// A fault that holds frames back and lets them go later. RT: safe.
#pragma once

#include <limits>

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class HeldFault : public Fault {
 public:
  using Fault::Fault;

  /// A late command comes after the next SYNC. At the end all come in their order, before what is new.
  void OnReceived(FrameBatch& frames, const Moment& at) noexcept final {
    if (over_) return OldFirst(frames, at, in_);
    Hold(frames, at, in_);
    in_.Release(at.cycle, batch_);
    frames = batch_;
  }
  void OnSent(FrameBatch& frames, const Moment& at) noexcept final { OldFirst(frames, at, out_); }
  void End() noexcept final { over_ = true; }
  bool pending() const noexcept final { return true; }

 protected:
  static constexpr std::int64_t kEver = std::numeric_limits<std::int64_t>::max();

  /// The cycle in which a frame that the fault hits goes on; the present one: it is not held.
  virtual std::int64_t Until(const Moment& at) noexcept = 0;
  std::int64_t cycles() const noexcept { return static_cast<std::int64_t>(size()); }

 private:
  void OldFirst(FrameBatch& frames, const Moment& at, HeldFrames& line) noexcept {
    released_.Clear();
    line.Release(over_ ? kEver : at.cycle, released_);
    Hold(frames, at, line);
    released_.Add(batch_.frames());
    frames = released_;
  }

  void Hold(FrameBatch& frames, const Moment& at, HeldFrames& line) noexcept {
    batch_.Clear();
    for (const bus::Frame& frame : frames) {
      const std::int64_t until = !over_ && Hits(frame) ? Until(at) : at.cycle;
      if (until > at.cycle)
        line.Hold(frame, until);
      else
        batch_.Add(frame);
    }
  }

  bool over_ = false;
  HeldFrames in_, out_;
  FrameBatch batch_, released_;
};

}  // namespace reed::plant
