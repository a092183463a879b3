// The unknown parameters of an arm file: names, values, boxes, and what each adds to which body. RT: set-up
// only.
#pragma once

#include "reed/config/schema/arm_description.h"
#include "reed/config/schema/reader.h"

namespace reed {

/// param_names, p_nom, p_lo, p_hi, [[param_shapes]] of the arm, p of its [truth] (or p_true of the arm); without
/// names every link's mass is one. The bodies are read before; what the file leaves out of them and of the truth
/// follows from the parameters.
void ReadParameters(Reader& in, Reader& truth, ArmDescription& arm);

}  // namespace reed
