// Torque below the play's width does not reach the arm. RT: safe.
#include <cmath>

#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class BacklashFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double asked_Nm, const Actuation&, const Moment&) noexcept override {
    const double through_Nm = std::abs(asked_Nm) - size();
    return through_Nm > 0.0 ? std::copysign(through_Nm, asked_Nm) : 0.0;
  }
};

}  // namespace

const Kind kBacklash{"backlash",
                     static_cast<std::uint32_t>(Seat::kDrive),
                     "N·m",
                     0.5,
                     0.0001,
                     1000.0,
                     false,
                     "torque below the play's width does not reach the arm",
                     &Make<BacklashFault>};

}  // namespace reed::plant
