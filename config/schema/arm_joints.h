// The keys of an arm file that say where its joints, its base and its tool are. RT: set-up only.
#pragma once

#include <vector>

#include "reed/config/schema/arm_description.h"
#include "reed/config/schema/reader.h"

namespace reed {

/// The table under this key; null where there is none.
toml::table* SectionOf(Reader& in, const char* key);

/// [[joint]], or `dh` as another way to write it.
std::vector<Joint> ReadJoints(Reader& in);

/// [base] and [tool], the latter also under its older names.
void ReadBaseAndTool(Reader& in, ArmDescription& arm);

/// [force_sensor], after the tool, whose frame it has where nothing else is said.
void ReadForceSensor(Reader& in, ArmDescription& arm);

}  // namespace reed
