#include "reed/config/schema/toml_text.h"

#include <sstream>

#include "reed/config/schema/bound.h"

namespace reed {
namespace {

class Printer {
 public:
  std::string Print(const toml::table& root) {
    Table(root, "");
    const std::string text = out_.str();
    return text.starts_with("\n") ? text.substr(1) : text;
  }

 private:
  static bool IsSection(const toml::node& node) { return node.is_table(); }
  static bool IsSectionList(const toml::node& node) {
    const toml::array* array = node.as_array();
    return array != nullptr && !array->empty() && array->is_homogeneous<toml::table>();
  }

  void Table(const toml::table& table, const std::string& name) {
    for (const auto& [key, node] : table) {
      if (IsSection(node) || IsSectionList(node)) continue;
      out_ << key.str() << " = ";
      Value(node);
      out_ << '\n';
    }
    for (const auto& [key, node] : table) {
      const std::string path = name.empty() ? std::string(key.str()) : name + "." + std::string(key.str());
      if (const toml::table* section = node.as_table()) {
        out_ << "\n[" << path << "]\n";
        Table(*section, path);
      } else if (IsSectionList(node)) {
        for (const toml::node& item : *node.as_array()) {
          out_ << "\n[[" << path << "]]\n";
          Table(*item.as_table(), path);
        }
      }
    }
  }

  void Value(const toml::node& node) {
    if (const toml::array* array = node.as_array()) {
      out_ << '[';
      const char* comma = "";
      for (const toml::node& item : *array) {
        out_ << comma;
        Value(item);
        comma = ", ";
      }
      out_ << ']';
    } else if (const auto* number = node.as_floating_point()) {
      const std::string text = ToText(number->get());
      // Without a point or an exponent TOML reads an integer; inf and nan never get this far.
      out_ << text << (text.find_first_of(".e") == std::string::npos ? ".0" : "");
    } else {
      node.visit([this](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) out_ << value;
      });
    }
  }

  std::ostringstream out_;
};

}  // namespace

std::string ToText(const toml::table& root) { return Printer().Print(root); }

}  // namespace reed
