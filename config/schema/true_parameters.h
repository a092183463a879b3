// Another truth for the same arm: what campaigns draw. RT: set-up only.
#pragma once

#include <vector>

#include "reed/config/schema/arm_description.h"

namespace reed {

/// Gives the parameters these true values and moves the bodies along: body + (p - truth) * unit, exactly in
/// mass, first moment and inertia. What is not a parameter, and so what the controller knows, stays as it is.
/// p: one number per parameter, within its box.
void SetTrueParameters(ArmDescription& arm, const std::vector<double>& p);

}  // namespace reed
