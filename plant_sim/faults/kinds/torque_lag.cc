// The drive's torque is late. RT: safe.
#include "reed/plant/faults/delay_line.h"
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class TorqueLagFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int joint, double asked_Nm, const Actuation&, const Moment& at) noexcept override {
    return line_.Of(static_cast<std::size_t>(joint), asked_Nm, at.since, size());
  }
  DelayLine<50> line_;
};

}  // namespace

const Kind kTorqueLag{"torque_lag",
                      static_cast<std::uint32_t>(Seat::kDrive),
                      "cycles",
                      10,
                      1,
                      49,
                      false,
                      "the drive's torque is late",
                      &Make<TorqueLagFault>};

}  // namespace reed::plant
