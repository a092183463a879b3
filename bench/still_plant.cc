// The plant program without its physics: the same endpoint, drives, sensors, frames and record, under them an
// arm that stands where it started. What a bus cycle costs can be measured with it alone. Wall clock.
// reed_still_plant GROUP PORT CORE
#include <cstdio>
#include <cstdlib>

#include "reed/bus/transport/open_transport.h"
#include "reed/config/plant/load_plant_config.h"
#include "reed/plant/endpoint/realtime_endpoint.h"
#include "reed/plant/process/realtime.h"
#include "reed/plant/process/stop_signal.h"
#include "reed/plant/record/publisher.h"

namespace reed::plant {
namespace {

class StillBody final : public ArmBody {
 public:
  void Reset(const Eigen::VectorXd& motor_angle_rad) override {
    truth_.motor_angle_rad = truth_.joint_angle_rad = motor_angle_rad;
    truth_.motor_speed_radps = Eigen::VectorXd::Zero(motor_angle_rad.size());
  }
  void Advance(const Eigen::VectorXd& /*motor_torque_Nm*/, bool /*braked*/, double /*dt_s*/) override {}
  const Truth& truth() const override { return truth_; }
  bool healthy() const override { return true; }
  std::string ailment() const override { return {}; }

 private:
  Truth truth_;
};

int Run(const std::string& bus, int core) {
  PlantConfig scenario = LoadPlantConfig("press_known");
  scenario.timing.plant_cpu = core;
  InstallStopSignals();
  StillBody body;
  const std::unique_ptr<bus::Transport> transport = bus::OpenTransport(bus);
  Publisher publisher({"", false, false, WhenFull::kDrop});
  WallEndpoint endpoint(scenario, *transport, body, publisher);
  AskForRealtime(scenario.timing);
  std::printf("waiting for SYNC\n");
  std::fflush(stdout);
  const auto now_ns = WallClock::System().monotonic_ns;
  while (!StopRequested()) endpoint.Poll(now_ns() + kStopCheck_ns);
  return 0;
}

}  // namespace
}  // namespace reed::plant

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  return reed::plant::Run(std::string("udp:") + argv[1] + ":" + argv[2],
                          static_cast<int>(std::strtol(argv[3], nullptr, 10)));
}
