// Two cables are exchanged. RT: safe.
#include <utility>

#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class SwappedChannelFault final : public Fault {
 public:
  using Fault::Fault;

  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    if (target().seat == Seat::kForce) {
      const int axis = target().axis < 0 ? 2 : target().axis;
      std::swap(m.wrench.force_N[axis], m.wrench.force_N[(axis + 1) % 3]);
      return;
    }
    const int joint = target().joint < 0 ? 0 : target().joint;
    bus::JointStateMessage& one = m.joints[static_cast<std::size_t>(joint)];
    bus::JointStateMessage& other = m.joints[static_cast<std::size_t>((joint + 1) % m.dof)];
    std::swap(one.position_rad, other.position_rad);
    std::swap(one.velocity_radps, other.velocity_radps);
  }
};

}  // namespace

const Kind kSwappedChannel{"swapped_channel",
                           Seat::kEncoder | Seat::kForce,
                           "",
                           0,
                           0,
                           0,
                           true,
                           "the reading and that of the next joint or axis are exchanged",
                           &Make<SwappedChannelFault>};

}  // namespace reed::plant
