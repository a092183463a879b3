// What each program may have of a whole file. RT: set-up only.
#pragma once

#include "reed/config/schema/scenario.h"

namespace reed {

/// Without the truth. coulomb_known: share of the declared Coulomb friction that the controller starts from, where
/// the arm does not state its nominal friction.
NominalArm NominalOf(const ArmDescription& arm, double coulomb_known = 0.0);

TrueArm TrueOf(const ArmDescription& arm);

ControllerConfig ControllerHalf(const Scenario& scenario);

PlantConfig PlantHalf(const Scenario& scenario);

}  // namespace reed
