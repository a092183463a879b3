// The drive's torque is late. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class TorqueLagFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int joint, double asked_Nm, const Actuation&, const Moment& at) noexcept override {
    std::array<double, kLongest>& line = line_[static_cast<std::size_t>(joint)];
    if (at.since == 0) line.fill(asked_Nm);
    const auto now = static_cast<std::size_t>(at.since);
    line[now % kLongest] = asked_Nm;
    const auto late = static_cast<std::size_t>(size());
    return now >= late ? line[(now - late) % kLongest] : line[(now + 1) % kLongest];
  }
  static constexpr std::size_t kLongest = 50;
  std::array<std::array<double, kLongest>, kMaxJoints> line_{};
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
