#include <algorithm>
#include <filesystem>

#include "reed/config/schema/allowed.h"
#include "reed/config/schema/arm_file.h"

namespace reed {

std::string FindConfig(const std::string& kind, const std::string& name_or_path) {
  namespace fs = std::filesystem;
  if (name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".toml") ||
      name_or_path.ends_with(".json"))
    return name_or_path;
  const fs::path folder = fs::path(REED_CONFIG_DIR) / kind;
  const fs::path file = folder / (name_or_path + ".toml");
  std::error_code ec;
  if (fs::is_regular_file(file, ec)) return file.string();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, ec))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  throw ConfigError(
      "no " + kind.substr(0, kind.size() - 1) + " '" + name_or_path + "'; " + Allowed(name_or_path, names) +
      (kind == "arms" ? ", or a path to a .toml or .json file" : ", or a path to a .toml file"));
}

}  // namespace reed
