// What the command line changes in a scenario. RT: set-up only.
#pragma once

#include <string>
#include <vector>

namespace reed {

struct LoadOptions {
  std::string arm;               // replaces the scenario's arm: name or path; "" keeps it
  std::vector<std::string> set;  // "SECTION.KEY=VALUE"
};

}  // namespace reed
