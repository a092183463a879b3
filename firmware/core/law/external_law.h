// A law from outside (reed/law.h) as the law bank sees it. RT: as safe as that law.
#pragma once

#include "reed/law.h"

namespace reed::strategy {

struct ExternalLaw {
  void (*step)(const reed_law_input*, void* state, reed_law_output*) = nullptr;
  void* state = nullptr;
  std::uint32_t traits = REED_LAW_FORCE_LOOP | REED_LAW_DEFLECTION;
  reed_law_output* output = nullptr;  // of the last step, for telemetry
  int num_values = 0;                 // of output->values that the law has named
};

}  // namespace reed::strategy
