// The wrist sensor falls silent. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class SilentFault final : public Fault {
 public:
  using Fault::Fault;
  void OnMeasurement(Measurement& m, const Moment&) noexcept override { m.wrench_lost = true; }
};

}  // namespace

const Kind kSilent{"silent",
                   static_cast<std::uint32_t>(Seat::kWrenchFrame),
                   "",
                   0,
                   0,
                   0,
                   true,
                   "the sensor sends nothing, and goes on counting where it stopped",
                   &Make<SilentFault>};

}  // namespace reed::plant
