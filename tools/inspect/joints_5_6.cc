#include "tools/inspect/arm_inspector_for.h"

namespace reed::inspect {

template std::unique_ptr<ArmInspector> MakeInspectorFor<5>(const ArmDescription& arm);
template std::unique_ptr<ArmInspector> MakeInspectorFor<6>(const ArmDescription& arm);

}  // namespace reed::inspect
