// A plant in lockstep on a fake wire.
#pragma once

#include "reed/tests/plant_sim/endpoint_rig.h"

namespace reed::plant {

using bus::DriveRequest;
using bus::DriveState;

inline constexpr double kPeriod_s = 1e-3;
inline constexpr double kLsb_rad = 6.283185307179586 / 1048576.0;  // of a 20-bit encoder
inline constexpr double kTau_Nm = 4.0;

class Lockstep : public ::testing::Test {
 protected:
  void Start(const PlantConfig& scenario) {
    endpoint_ = std::make_unique<LockstepEndpoint>(scenario, wire_.plant, body_, recorder_);
  }
  Lockstep() { Start(TwoJointScenario()); }

  Answer SyncAndTake(std::uint32_t cycle) {
    controller_.Sync(cycle);
    endpoint_->Poll(0);
    return controller_.Take();
  }
  Answer Cycle(std::uint32_t cycle, DriveRequest request, double tau_Nm = 0.0) {
    Answer answer = SyncAndTake(cycle);
    controller_.Command(cycle, request, tau_Nm);
    endpoint_->Poll(0);
    return answer;
  }
  /// Cycles 0 and 1 ask for ready and enable; the enable acts in the period that SYNC 2 starts.
  void Enable() {
    Cycle(0, DriveRequest::kReady);
    Cycle(1, DriveRequest::kEnable);
  }
  DriveState state() const { return endpoint_->robot().drives().state(); }

  test::FakeWire wire_;
  RotorBody body_;
  VectorRecorder recorder_;
  FakeController controller_{wire_.controller};
  std::unique_ptr<LockstepEndpoint> endpoint_;
};

}  // namespace reed::plant
