// What a number in a file may be. The same bound checks it, documents it, and is quoted in the error.
#pragma once

#include <string>

#include "reed/config/description/number_text.h"

namespace reed {

struct Bound {
  const char* unit;  // "1" for a pure number
  double lo;
  double hi;
};

/// "0.1 ... 3600 s"
std::string ToText(const Bound& bound);
}  // namespace reed
