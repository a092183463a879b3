#include "reed/inspect/arm_inspector.h"

#include <stdexcept>
#include <string>

namespace reed::inspect {

std::unique_ptr<ArmInspector> MakeInspector(const ArmDescription& arm) {
  switch (arm.dof()) {
    case 1:
      return MakeInspectorFor<1>(arm);
    case 2:
      return MakeInspectorFor<2>(arm);
    case 3:
      return MakeInspectorFor<3>(arm);
    case 4:
      return MakeInspectorFor<4>(arm);
    case 5:
      return MakeInspectorFor<5>(arm);
    case 6:
      return MakeInspectorFor<6>(arm);
    case 7:
      return MakeInspectorFor<7>(arm);
    case 8:
      return MakeInspectorFor<8>(arm);
    default:
      break;
  }
  throw std::invalid_argument(arm.name + ": " + std::to_string(arm.dof()) + " joints; allowed: 1 ... " +
                              std::to_string(kMaxJoints));
}

}  // namespace reed::inspect
