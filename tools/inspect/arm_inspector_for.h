// ArmInspector for N joints: puts together what the parts below compute. Included by joints.cc.in only,
// which instantiate it, so that the recursions are compiled once per number of joints. RT: set-up only.
#pragma once

#include "reed/inspect/arm_inspector.h"
#include "reed/inspect/control_cases.h"
#include "reed/inspect/elastic_cases.h"
#include "reed/inspect/rigid_cases.h"

namespace reed::inspect {

template <int N>
class ArmInspectorFor final : public ArmInspector {
 public:
  explicit ArmInspectorFor(const ArmDescription& description) : arm_(description) {}

  NamedValues Inspect(const NamedValues& in) const override {
    NamedValues out;
    if (!in.Has("q")) return out;
    Arm<N> arm = arm_;
    if (in.Has("tool_offset")) arm.tool_offset = in.Vector<3>("tool_offset");
    InspectRigid(arm, in, out);
    InspectElastic(arm, in, out);
    InspectControl(arm, in, out);
    return out;
  }

 private:
  Arm<N> arm_;
};

template <int N>
std::unique_ptr<ArmInspector> MakeInspectorFor(const ArmDescription& arm) {
  return std::make_unique<ArmInspectorFor<N>>(arm);
}

}  // namespace reed::inspect
