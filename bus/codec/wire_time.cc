#include "reed/bus/codec/wire_time.h"

#include "reed_layout.h"

namespace reed::bus {

double AnswerTime_s(int joints, BitRates rates) noexcept {
  return FrameTime_s(layout::kSync.size, rates) + joints * FrameTime_s(layout::kJointState[0].size, rates) +
         FrameTime_s(layout::kWrench.size, rates);
}

double CommandTime_s(BitRates rates) noexcept { return FrameTime_s(layout::kCommand.size, rates); }

double CycleTime_s(int joints, BitRates rates) noexcept {
  return AnswerTime_s(joints, rates) + CommandTime_s(rates);
}

double WireLoad(int joints, double rate_hz, BitRates rates) noexcept {
  return CycleTime_s(joints, rates) * rate_hz;
}

bool ScheduleFits(int joints, double rate_hz, BitRates rates) noexcept {
  return WireLoad(joints, rate_hz, rates) <= 1.0;
}

double MaxRate_hz(int joints, BitRates rates) noexcept { return 1.0 / CycleTime_s(joints, rates); }

}  // namespace reed::bus
