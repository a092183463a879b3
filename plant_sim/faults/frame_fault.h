// A fault of frames: the same one for those that the arm sends and those that it receives. RT: safe.
#pragma once

#include "reed/plant/faults/fault.h"

namespace reed::plant {

class FrameFault : public Fault {
 public:
  using Fault::Fault;

  void OnReceived(FrameBatch& frames, const Moment& at) noexcept final { Pass(frames, at, true); }
  void OnSent(FrameBatch& frames, const Moment& at) noexcept final { Pass(frames, at, false); }

 protected:
  /// received: on their way to the arm.
  virtual void Pass(FrameBatch& frames, const Moment& at, bool received) noexcept = 0;
};

}  // namespace reed::plant
