// A drive stops by itself, as after an overcurrent, and reports it. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class DriveTripsFault final : public Fault {
 public:
  explicit DriveTripsFault(const Making& making) : target_(making.target) {}

  void OnActuation(Actuation& act, const Moment&) noexcept override {
    for (int joint = 0; joint < static_cast<int>(act.torque_Nm.size()); ++joint) {
      if (!target_.Has(joint)) continue;
      act.torque_Nm[joint] = 0.0;
      act.brakes_closed |= 1U << static_cast<unsigned>(joint);
    }
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    for (int joint = 0; joint < m.dof; ++joint) {
      if (!target_.Has(joint)) continue;
      m.joints[static_cast<std::size_t>(joint)].state = bus::DriveState::kFault;
      m.joints[static_cast<std::size_t>(joint)].torque_Nm = 0.0;
    }
  }

 private:
  Target target_;
};

}  // namespace

const Kind kDriveTrips{"drive_trips",
                       static_cast<std::uint32_t>(Seat::kDrive),
                       "",
                       0,
                       0,
                       0,
                       true,
                       "the drive stops with its brake closed and says so",
                       &Make<DriveTripsFault>};

}  // namespace reed::plant
