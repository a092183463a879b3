// The plant program without its physics: the same endpoint, drives, sensors, frames and record, under them an
// arm that stays where it started. It measures the cost of a bus cycle alone. Clock realtime.
// reed_still_plant GROUP PORT CORE
#include <cstdio>
#include <cstdlib>

#include "reed/bus/transport/open_transport.h"
#include "reed/config/plant/load_plant_config.h"
#include "reed/plant/endpoint/realtime_endpoint.h"
#include "reed/plant/process/realtime_wish.h"
#include "reed/plant/record/publisher.h"
#include "reed/rt/monotonic.h"
#include "reed/rt/program.h"
#include "reed/rt/signals.h"

namespace reed::plant {
namespace {

class StillBody final : public ArmBody {
 public:
  void Reset(const Eigen::VectorXd& motor_angle_rad) override {
    truth_.motor_angle_rad = truth_.joint_angle_rad = motor_angle_rad;
    truth_.motor_speed_radps = Eigen::VectorXd::Zero(motor_angle_rad.size());
  }
  void StartSchedule() override {}
  void Advance(const Eigen::VectorXd& /*motor_torque_Nm*/, bool /*braked*/, double /*dt_s*/) override {}
  const Truth& truth() const override { return truth_; }
  const ArmShape& Shape() override { return shape_; }
  bool healthy() const override { return true; }
  std::string fault_description() const override { return {}; }

 private:
  Truth truth_;
  ArmShape shape_{{Eigen::Vector3d::Zero()}, {Eigen::Vector3d::Zero()}};
};

int Run(const std::string& bus, int core) {
  PlantConfig scenario = LoadPlantConfig("press_known");
  scenario.timing.plant_cpu = core;
  const std::atomic<bool>& stop = rt::StopFlag();
  StillBody body;
  const std::unique_ptr<bus::Transport> transport = bus::OpenTransport(bus);
  Publisher publisher({"", false, false, WhenFull::kDrop});
  RealtimeEndpoint endpoint(scenario, *transport, body, publisher);
  const rt::RealtimeScope realtime(RealtimeWish(scenario.timing));
  std::printf("waiting for SYNC\n");
  std::fflush(stdout);
  constexpr std::int64_t kStopCheck_ns = 60'000'000;
  while (!stop.load(std::memory_order_relaxed)) endpoint.Poll(rt::NowNs() + kStopCheck_ns);
  return 0;
}

}  // namespace
}  // namespace reed::plant

int main(int argc, char** argv) {
  if (argc < 4) return reed::rt::kBadInput;
  return reed::rt::RunProgram("reed_still_plant", [&] {
    return reed::plant::Run(std::string("udp:") + argv[1] + ":" + argv[2],
                            static_cast<int>(std::strtol(argv[3], nullptr, 10)));
  });
}
