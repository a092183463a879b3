// The simulated arm as it really is. Only the plant and those who judge it may hold one. RT: set-up only (it
// owns heap memory).
#pragma once

#include <vector>

#include "reed/config/description/arm_structure.h"

namespace reed {

struct TrueArm : ArmStructure {
  std::vector<InertialBody> bodies;     // totals, one per link
  std::vector<double> viscous_Nmsprad;  // per joint; empty: none
  std::vector<double> coulomb_Nm;       // per joint; empty: none
};

}  // namespace reed
