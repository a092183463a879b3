// TOML as people would type it: every number in the shortest form that reads back as the same double (the
// library's own printer writes 17 digits). RT: set-up only.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace reed {

/// Values first, then sections, then lists of sections; keys in alphabetical order.
std::string ToText(const toml::table& root);

}  // namespace reed
