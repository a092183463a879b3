// Writes the sample snapshots through the recorder: the file that test_recorded_files.py reads with foreign
// programs. Usage: reed_record_sample LOG CANDUMP CYCLES [LCM_URL]
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "reed/firmware/record/recorder.h"
#include "reed/tests/telemetry/sample_snapshot.h"

int main(int argc, char** argv) {
  using namespace reed::telemetry;
  if (argc < 4) return 2;
  RecorderOptions options{argv[1], argv[2], "vcan0", argc > 4, argc > 4 ? argv[4] : ""};
  SnapshotRing ring(256);
  Recorder recorder(options, TimeBase::Lockstep(1000.0), ring, reed::test::SampleEventText);
  reed::run_t run{};
  run.scenario = "sample";
  recorder.RecordRun(run);
  recorder.Start();
  const std::int64_t cycles = std::strtoll(argv[3], nullptr, 10);
  for (std::int64_t cycle = 0; cycle < cycles;) {
    if (ring.Push(reed::test::SampleSnapshot(cycle, 5, 6))) {
      ++cycle;
    } else {
      usleep(100);
    }
  }
  recorder.Stop();
  run.finished = 1;
  recorder.RecordRun(run);
  for (const std::string& line : recorder.Close().Problems()) std::fprintf(stderr, "%s\n", line.c_str());
}
