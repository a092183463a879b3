// The one error of everything a user writes: a line that says where, what, and what is allowed.
#pragma once

#include <stdexcept>
#include <string>

namespace reed {

/// "file:line: key: problem; allowed: ...". Programs print it and exit with 2. RT: set-up only.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace reed
