// A drive stops by itself, as after an overcurrent, and reports it. RT: safe.
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/stopped_drive.h"

namespace reed::plant {
namespace {

class DriveTripsFault final : public StoppedDrive {
 public:
  explicit DriveTripsFault(const Making& making) : StoppedDrive(making, bus::DriveState::kFault) {}
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
