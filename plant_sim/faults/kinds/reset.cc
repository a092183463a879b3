// A drive's processor restarts. RT: safe.
#include "reed/bus/codec/reprotect.h"
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/stopped_drive.h"

namespace reed::plant {
namespace {

class ResetFault final : public StoppedDrive {
 public:
  explicit ResetFault(const Making& making) : StoppedDrive(making, bus::DriveState::kOff) {}

  void OnSent(FrameBatch& frames, const Moment& at) noexcept override {
    const bool boots = at.since_s() < size();
    if (boots) frames.RemoveIf([this](const bus::Frame& frame) { return Hits(frame); });
    for (bus::Frame& frame : frames)
      if (Hits(frame)) bus::Reprotect(frame, counter_);
    if (!boots) ++counter_;
  }

 private:
  std::uint8_t counter_ = 0;
};

}  // namespace

const Kind kReset{"reset",
                  static_cast<std::uint32_t>(Seat::kNode),
                  "s",
                  0.02,
                  0,
                  10,
                  true,
                  "the node starts anew: silent for size, then off, its counter from zero, its brake closed",
                  &Make<ResetFault>};

}  // namespace reed::plant
