// Everything that the firmware's model and laws say about one arm, for cases given by name. RT: set-up only.
#pragma once

#include <memory>

#include "reed/config/schema/arm_description.h"
#include "reed/inspect/named_values.h"

namespace reed::inspect {

class ArmInspector {
 public:
  virtual ~ArmInspector() = default;
  /// From the inputs of a case whatever they allow. Throws CaseError where an input has the wrong size.
  virtual NamedValues Inspect(const NamedValues& in) const = 0;
};

/// For 1 ... kMaxJoints joints. Throws std::invalid_argument when the arm is inconsistent.
std::unique_ptr<ArmInspector> MakeInspector(const ArmDescription& arm);

/// The same where the number of joints is a constant, as it is in the firmware.
template <int N>
std::unique_ptr<ArmInspector> MakeInspectorFor(const ArmDescription& arm);

}  // namespace reed::inspect
