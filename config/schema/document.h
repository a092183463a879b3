// A configuration document: one TOML (or JSON) tree with the place where every value was written.
// RT: set-up only.
#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

#include "reed/config/description/config_error.h"

namespace reed {

class Document {
 public:
  /// Throws ConfigError: no such file, or file:line of the first syntax error. ".json" files are read as
  /// JSON.
  static Document Load(const std::string& path);

  /// Replaces the value at `section` by another document's tree (the arm's file inside a scenario).
  void Graft(const std::string& section, Document&& other);

  /// "SECTION.KEY=VALUE"; array entries by number (arm.sections.0.EI). Throws ConfigError when the path does
  /// not exist and cannot be a key, or the value is not TOML.
  /// `typed`: the key as the user wrote it, where it has moved since.
  void Override(const std::string& assignment, const std::string& typed = "");

  toml::table& root() { return root_; }
  const std::string& path() const { return path_; }
  /// The file's name without folder and ending, as long as a name may be: what a scenario or an arm without a name is called.
  std::string stem() const;

  /// Throws ConfigError "file:line: key: problem".
  [[noreturn]] void Fail(const toml::node* where, const std::string& key, const std::string& problem) const;

 private:
  std::string path_;
  toml::table root_;
  std::map<std::string, std::string> overridden_;  // keys that came from --set, and how they were typed
  std::vector<std::pair<std::string, std::string>>
      json_texts_;  // path, text: JSON nodes carry no line, it is looked up
};

}  // namespace reed
