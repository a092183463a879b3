// How a link's rigid body becomes mass along its members plus a rigid rest. RT: set-up only.
#pragma once

#include <vector>

#include "reed/plant/dynamics/beam_inertia.h"
#include "reed/plant/dynamics/rigid_body.h"

namespace reed::plant {

/// One straight member of a link before it is cut into elements.
struct LinkMember {
  Placement base;        // x along the member, in the link frame
  double length = 0.0;   // m
  double density = 0.0;  // kg/m, of the section; after the split: its share of the link's mass
  double polar = 0.0;    // kg·m, mass moment of inertia about the axis per length; likewise
  RelativeMass
      relative;  // after the split: the section's material that the link's description has no mass for
};

/// Lays as much of the body's mass evenly along the members, in proportion to their sections' densities, as
/// leaves a rest that can exist, and returns the rest: members + rest = body exactly (mass, centre of mass,
/// inertia). A link given as a uniform rod is all member; what is given as lumps stays in the rest.
/// Everything in the link frame.
RigidBody SplitMass(const RigidBody& body, std::vector<LinkMember>& members);

}  // namespace reed::plant
