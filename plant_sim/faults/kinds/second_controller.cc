// Somebody else commands the arm. RT: safe.
#include "reed/bus/codec/messages.h"
#include "reed/plant/faults/altered.h"
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class SecondControllerFault final : public Fault {
 public:
  using Fault::Fault;

  void OnReceived(FrameBatch& frames, const Moment&) noexcept override {
    batch_.Clear();
    for (const bus::Frame& frame : frames) {
      batch_.Add(frame);
      if (frame.id == bus::layout::kCommand.id) batch_.Add(Altered(frame, {.value = size()}));
    }
    frames = batch_;
  }
  void OnSent(FrameBatch& frames, const Moment& at) noexcept override {
    frames.Add(writer_.Sync({static_cast<std::uint32_t>(at.cycle), bus::layout::kLayoutId}));
  }

 private:
  bus::FrameEncoder writer_;
  FrameBatch batch_;
};

}  // namespace

const Kind kSecondController{"second_controller",
                             static_cast<std::uint32_t>(Seat::kController),
                             "N·m on joint 1",
                             1.0,
                             -1e3,
                             1e3,
                             true,
                             "another controller sends SYNC and commands",
                             &Make<SecondControllerFault>};

}  // namespace reed::plant
