#include "tools/inspect/arm_inspector_for.h"

namespace reed::inspect {

template std::unique_ptr<ArmInspector> MakeInspectorFor<7>(const ArmDescription& arm);
template std::unique_ptr<ArmInspector> MakeInspectorFor<8>(const ArmDescription& arm);

}  // namespace reed::inspect
