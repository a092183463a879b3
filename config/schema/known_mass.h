// What the uncertain parameters leave of the bodies, and back. RT: set-up only.
#pragma once

#include <vector>

#include "reed/config/schema/arm_description.h"

namespace reed {

/// Known part of every link: its total minus truth times unit of every parameter.
std::vector<KnownMass> KnownOf(const ArmDescription& arm);

/// The link of that mass: what a file without bodies means by its known_bodies.
InertialBody BodyOf(const KnownMass& mass);

/// body + share * unit; about the origin all three moments add.
void Add(InertialBody& body, double share, const InertialBody& unit);

}  // namespace reed
