// The drive's torque is noisy. RT: safe.
#include "reed/plant/faults/drive_fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class TorqueNoiseFault final : public DriveFault {
  using DriveFault::DriveFault;
  double Delivered(int, double asked_Nm, const Actuation&, const Moment& at) noexcept override {
    return asked_Nm + size() * at.random.Normal();
  }
};

}  // namespace

const Kind kTorqueNoise{"torque_noise",
                        static_cast<std::uint32_t>(Seat::kDrive),
                        "N·m, standard deviation",
                        1.0,
                        0,
                        1000.0,
                        false,
                        "the drive's torque is noisy",
                        &Make<TorqueNoiseFault>};

}  // namespace reed::plant
