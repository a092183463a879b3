// What a tape says about itself: lines "key value", one line per field of a cycle, then the controller's whole
// configuration. For an ordinary thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace reed::tape {

struct Field {
  std::string role;  // "in" or "out"
  std::string name;
  std::string type;  // tape_fields.h, TypeName
  int count = 1;
};

struct Header {
  std::uint32_t schema = 0;
  std::string reed;    // version of the program
  std::string commit;  // of its tree, as far as who started it knew
  std::string scenario, arm, law;
  std::string law_library;  // --law of the run; empty: the scenario's own
  std::string clock;        // "realtime" or "lockstep"
  double rate_hz = 0.0;
  int joints = 0, parameters = 0;
  bool enable = false;  // the operator's wish to open the brakes
  std::string config;   // TOML
  std::vector<Field> fields;
};

/// With the fields of this program's cycles.
std::string ToText(const Header& header);

/// @throws std::runtime_error with one line where it cannot be read
Header FromText(const std::string& text);

}  // namespace reed::tape
