// "Permission denied" and the like, for lines that people read. RT: set-up only.
#pragma once

#include <cerrno>
#include <string>
#include <system_error>

namespace reed::rt {

inline std::string ErrnoText(int error = errno) { return std::generic_category().message(error); }

}  // namespace reed::rt
