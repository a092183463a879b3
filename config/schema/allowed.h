#pragma once

#include <string>
#include <vector>

namespace reed {

/// "allowed: a, b, c", behind "did you mean 'b'? " where `word` is as near to one of them as a slip of the fingers.
std::string Allowed(const std::string& word, const std::vector<std::string>& allowed);

}  // namespace reed
