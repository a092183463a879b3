// What telemetry costs the loop: a slot of the ring, a cycle's numbers and frames into it, and publishing it,
// with the whole recorder at work in its thread (event log, CAN log, LCM). The other side, an empty recorder,
// costs nothing. Between bursts the recorder is given time to empty the ring. reed_bench_telemetry FOLDER
#include <cstdio>

#include "reed/bench/control_step.h"
#include "reed/config/controller/load_controller_config.h"
#include "reed/firmware/cycle/fill.h"
#include "reed/firmware/record/recorder.h"

namespace reed::bench {
namespace {

constexpr std::size_t kFrames = 8;
constexpr int kBursts = 40;

std::array<bus::Frame, kFrames> FramesOfACycle() {
  bus::FrameEncoder encoder;
  std::array<bus::Frame, kFrames> frames{encoder.Sync({})};
  for (int i = 0; i < 5; ++i) frames[static_cast<std::size_t>(i) + 1] = encoder.JointState(i, {});
  frames[6] = encoder.Wrench({});
  frames[7] = encoder.Command({});
  return frames;
}

/// What Cycle and ArmBus leave in a snapshot: SYNC, the answers with their reading of the clock, the command.
void Record(ControlStep<5, 7>& step, const std::array<bus::Frame, kFrames>& frames, int k,
            telemetry::Snapshot& snapshot) {
  using telemetry::Direction;
  snapshot.ClearLists();
  snapshot.cycle = k;
  snapshot.AddFrame(frames.front(), Direction::kSent, 0);
  const auto at_ns = static_cast<std::int32_t>(rt::MonotonicClock{}.NowNs() - snapshot.time_ns);
  for (std::size_t i = 1; i + 1 < kFrames; ++i) snapshot.AddFrame(frames[i], Direction::kReceived, at_ns);
  snapshot.AddFrame(frames.back(), Direction::kSent, at_ns);
  snapshot.dof = 5;
  snapshot.num_parameters = 6;
  telemetry::FillMeasured(step.measured(k), snapshot.measured);
  telemetry::FillControl(step.controller(), snapshot.control);
  telemetry::FillAdaptation(step.controller().strategy().adaptive(), snapshot.adaptation);
  telemetry::FillBus({}, {}, 0, snapshot.bus);
}

int Run(const std::string& folder) {
  ControlStep<5, 7> step(LoadControllerConfig("press_known"));
  Keep(step.Run(0));
  telemetry::SnapshotRing ring(1024);
  telemetry::Recorder recorder(
      {folder + "/telemetry.lcmlog", folder + "/telemetry.candump", "bench", true, ""},
      telemetry::TimeBase::Lockstep(1000.0), ring, [](int) { return ""; });
  recorder.Start();
  const std::array<bus::Frame, kFrames> frames = FramesOfACycle();
  const rt::MonotonicClock clock;
  std::vector<double> ns;
  for (int burst = 0; burst < kBursts; ++burst) {
    const std::int64_t start = clock.NowNs();
    for (int i = 0; i < kInputs; ++i) {
      telemetry::Snapshot* slot = ring.Claim();
      if (slot == nullptr) return 3;
      Record(step, frames, burst * kInputs + i, *slot);
      ring.Publish();
    }
    ns.push_back(static_cast<double>(clock.NowNs() - start) / kInputs);
    clock.SleepUntil(clock.NowNs() + 20'000'000);
  }
  recorder.Stop();
  std::sort(ns.begin(), ns.end());
  std::printf("{\"name\": \"telemetry\", \"best_ns\": %.1f, \"median_ns\": %.1f}\n", ns.front(),
              ns[ns.size() / 2]);
  return 0;
}

}  // namespace
}  // namespace reed::bench

int main(int argc, char** argv) { return argc > 1 ? reed::bench::Run(argv[1]) : 2; }
