// Asymmetric information: the drive of one joint keeps its last torque, and reports it. RT: safe.
#include "reed/plant/faults/fault.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

class SubsetFault final : public Fault {
 public:
  explicit SubsetFault(const Making& making) : Fault(making), joint_(static_cast<int>(making.size) - 1) {}

  void OnActuation(Actuation& act, const Moment& at) noexcept override {
    if (joint_ >= act.dof() || act.braked) return;
    if (at.since == 0) held_Nm_ = act.torque_Nm[joint_];
    act.torque_Nm[joint_] = held_Nm_;
    acted_ = true;
  }
  void OnMeasurement(Measurement& m, const Moment&) noexcept override {
    if (acted_ && joint_ < m.dof) m.joints[static_cast<std::size_t>(joint_)].torque_Nm = held_Nm_;
  }

 private:
  int joint_;
  double held_Nm_ = 0.0;
  bool acted_ = false;
};

}  // namespace

const Kind kSubset{"subset",
                   static_cast<std::uint32_t>(Seat::kCommandFrame),
                   "joint",
                   2,
                   1,
                   kMaxJoints,
                   false,
                   "one drive does not receive the commands that the others do",
                   &Make<SubsetFault>};

}  // namespace reed::plant
