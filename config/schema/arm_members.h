// What bends of an arm file: [[member]] tables, or sections that follow the rows. RT: set-up only.
#pragma once

#include "reed/config/schema/arm_description.h"
#include "reed/config/schema/reader.h"

namespace reed {

/// [[sections]] or [[member]], after the joints. Neither: rigid links.
void ReadFlexibleMembers(Reader& in, ArmDescription& arm);

}  // namespace reed
