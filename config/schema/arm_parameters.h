// The unknown parameters of an arm file: names, values, boxes, and what each adds to which body. RT: set-up
// only.
#pragma once

#include "reed/config/description/arm_description.h"
#include "reed/config/schema/reader.h"

namespace reed {

/// param_names, p_true, p_nom, p_lo, p_hi, [[param_shapes]]; without names every link's mass is one. The
/// bodies are read before.
void ReadParameters(Reader& in, ArmDescription& arm);

}  // namespace reed
