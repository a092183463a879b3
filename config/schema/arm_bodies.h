// The tables of an arm file that describe rigid bodies. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/schema/arm_description.h"
#include "reed/config/schema/reader.h"

namespace reed {

/// Mass, centre of mass and inertia, checked to be those of a body. `first_link` only turns about its own z.
InertialBody ReadBody(Reader& in, const char* inertia_key, bool first_link);

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
    Reader item(in.document(), table, in.KeyName(name), in.joints());
    each(item, i);
    item.RefuseUnknown();
  }
}

/// [[bodies]], one per link; `in` is the arm or its [truth].
void ReadBodies(Reader& in, ArmDescription& arm);

/// [[known_bodies]], one per link or none.
void ReadKnownBodies(Reader& in, ArmDescription& arm);

}  // namespace reed
