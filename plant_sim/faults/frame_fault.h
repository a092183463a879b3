// A fault of frames: the same one for those that the arm sends and those that it receives. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class FrameFault : public Fault {
 public:
  explicit FrameFault(const Making& making) : target_(making.target), size_(making.size) {}

  void OnReceived(FrameBatch& frames, const Moment& at) noexcept final { Pass(frames, at, true); }
  void OnSent(FrameBatch& frames, const Moment& at) noexcept final { Pass(frames, at, false); }

 protected:
  /// received: on their way to the arm.
  virtual void Pass(FrameBatch& frames, const Moment& at, bool received) noexcept = 0;
  bool Hits(const bus::Frame& frame) const noexcept { return target_.Carries(frame.id); }
  double size() const noexcept { return size_; }
  const Target& target() const noexcept { return target_; }

 private:
  Target target_;
  double size_;
};

}  // namespace reed::plant
