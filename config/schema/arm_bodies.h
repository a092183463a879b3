// The tables of an arm file that describe rigid bodies. RT: set-up only.
#pragma once

#include <string>
#include <vector>

#include "reed/config/description/arm_description.h"
#include "reed/config/schema/reader.h"

namespace reed {

inline constexpr Bound kLength{"m", -10.0, 10.0};  // beyond: millimetres

/// A list of equally long rows of numbers.
std::vector<std::vector<double>> ReadRows(Reader& in, const char* key, std::size_t width);

/// Mass, centre of mass and inertia, checked to be those of a body. `first_link` only turns about its own z.
InertialBody ReadBody(Reader& in, const char* inertia_key, bool first_link);

/// [[bodies]], one per link.
void ReadBodies(Reader& in, ArmDescription& arm);

/// A list of tables: each(reader of the table, its index).
template <typename Each>
void ForEachTable(Reader& in, const char* key, Each each) {
  toml::node* node = in.Get(key);
  if (node == nullptr) return;
  toml::array* array = node->as_array();
  if (array == nullptr) in.Fail(key, "expected a list of tables");
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string name = std::string(key) + "[" + std::to_string(i) + "]";
    toml::table* table = (*array)[i].as_table();
    if (table == nullptr) in.document().Fail(&(*array)[i], in.KeyName(name), "expected a table");
    Reader item(in.document(), table, in.KeyName(name));
    each(item, i);
    item.RefuseUnknown();
  }
}

}  // namespace reed
