#include "reed/firmware/tape/tape_header.h"

#include <charconv>
#include <sstream>
#include <stdexcept>

#include "reed/firmware/tape/tape_fields.h"
#include "reed/firmware/tape/tape_format.h"

namespace reed::tape {
namespace {

constexpr const char* kConfig = "config\n";  // the last line before the configuration

/// A value stays on its line.
std::string OneLine(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

std::string Exact(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

double Number(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::string ToText(const Header& h) {
  std::ostringstream out;
  out << "schema " << kSchema << "\nreed " << OneLine(h.reed) << "\ncommit " << OneLine(h.commit)
      << "\nscenario " << OneLine(h.scenario) << "\narm " << OneLine(h.arm) << "\nlaw " << OneLine(h.law)
      << "\nlaw_library " << OneLine(h.law_library) << "\nclock " << h.clock << "\nrate_hz "
      << Exact(h.rate_hz) << "\njoints " << h.joints << "\nparameters " << h.parameters << "\nenable "
      << h.enable << '\n';
  telemetry::Snapshot any;
  Fields(any, h.joints, h.parameters, [&](Role role, const char* name, const auto* first, int count) {
    using T = std::remove_cvref_t<decltype(*first)>;
    out << "field " << (role == Role::kInput ? "in " : "out ") << name << ' ' << TypeName<T>() << ' ' << count
        << '\n';
  });
  out << kConfig << h.config;
  return out.str();
}

Header FromText(const std::string& text) {
  const std::size_t end = text.find(std::string("\n") + kConfig);
  if (end == std::string::npos) throw std::runtime_error("its header has no configuration");
  Header h;
  h.config = text.substr(end + 1 + std::string(kConfig).size());
  std::istringstream lines(text.substr(0, end));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    const std::string key = line.substr(0, blank);
    const std::string value = blank == std::string::npos ? "" : line.substr(blank + 1);
    if (key == "schema") h.schema = static_cast<std::uint32_t>(Number(value));
    if (key == "reed") h.reed = value;
    if (key == "commit") h.commit = value;
    if (key == "scenario") h.scenario = value;
    if (key == "arm") h.arm = value;
    if (key == "law") h.law = value;
    if (key == "law_library") h.law_library = value;
    if (key == "clock") h.clock = value;
    if (key == "rate_hz") h.rate_hz = Number(value);
    if (key == "joints") h.joints = static_cast<int>(Number(value));
    if (key == "parameters") h.parameters = static_cast<int>(Number(value));
    if (key == "enable") h.enable = value == "1";
    if (key != "field") continue;
    Field field;
    std::istringstream words(value);
    words >> field.role >> field.name >> field.type >> field.count;
    h.fields.push_back(field);
  }
  return h;
}

}  // namespace reed::tape
