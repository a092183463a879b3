// An arm file as it stands: what one may know of the arm and, apart, what is true of the simulated one. Only the
// reader of files and the tools that show everything hold both; the programs take their half (halves.h).
// RT: set-up only (it owns heap memory).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reed/config/controller/nominal_arm.h"
#include "reed/config/plant/true_arm.h"

namespace reed {

/// One uncertain structural parameter with its true value.
struct StructuralParameter : NominalParameter {
  StructuralParameter() = default;
  StructuralParameter(std::string name_, double truth_, double nominal_, double lo_, double hi_,
                      std::vector<ParameterShape> shapes_, std::vector<double> viscous_weights_)
      : NominalParameter{std::move(name_),           nominal_, lo_, hi_, std::move(shapes_),
                         std::move(viscous_weights_)},
        truth(truth_) {}

  double truth = 0.0;
};

struct ArmDescription : ArmStructure {
  std::vector<StructuralParameter> parameters;  // at most kMaxParameters
  std::vector<double> coulomb_nominal_Nm;       // empty: control.coulomb_known of the declared
  std::vector<double> coulomb_declared_Nm;      // empty: what the controller starts from
  // [truth]
  std::vector<InertialBody> bodies;     // totals, one per link, parameters at their truth included
  std::vector<double> coulomb_Nm;       // per joint; empty: none
  std::vector<double> viscous_Nmsprad;  // per joint; empty: what the parameters say
  std::vector<KnownMass> known;  // of each link, without the parameters; empty: what they leave of bodies

  int num_parameters() const { return static_cast<int>(parameters.size()); }
};

}  // namespace reed
