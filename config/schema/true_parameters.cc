#include "reed/config/schema/true_parameters.h"

#include "reed/config/schema/known_mass.h"

namespace reed {

void SetTrueParameters(ArmDescription& arm, const std::vector<double>& p) {
  if (arm.known.empty()) arm.known = KnownOf(arm);
  for (std::size_t k = 0; k < p.size(); ++k) {
    StructuralParameter& parameter = arm.parameters[k];
    const double change = p[k] - parameter.truth;
    if (change == 0.0) continue;  // a written configuration is read back as it is
    for (const ParameterShape& shape : parameter.shapes)
      Add(arm.bodies[static_cast<std::size_t>(shape.body)], change, shape.unit);
    parameter.truth = p[k];
  }
}

}  // namespace reed
