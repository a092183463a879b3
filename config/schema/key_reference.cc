// The third visitor: lists every key for config/README.md, so the page cannot drift from the reader.
#include <sstream>

#include "reed/config/schema/scenario_fields.h"
#include "reed/config/schema/scenario_file.h"

namespace reed {
namespace {

class Lister {
 public:
  Lister(std::ostringstream& out, std::string section) : out_(out), section_(std::move(section)) {}

  void Number(const char* key, double value, Bound bound, const char* doc) {
    Row(key, ToText(bound), ToText(value), doc);
  }
  void Integer(const char* key, int value, Bound bound, const char* doc) {
    Row(key, ToText(bound), std::to_string(value), doc);
  }
  void Seed(const char* key, std::int64_t value, const char* doc) {
    Row(key, "whole number >= 0", std::to_string(value), doc);
  }
  void Boolean(const char* key, bool value, const char* doc) {
    Row(key, "true, false", value ? "true" : "false", doc);
  }
  void Text(const char* key, const std::string& value, const char* doc) { Row(key, "text", value, doc); }
  void Vector(const char* key, const Eigen::Vector3d& v, Bound bound, const char* doc) {
    Row(key, "[x, y, z], each " + ToText(bound),
        "[" + ToText(v.x()) + ", " + ToText(v.y()) + ", " + ToText(v.z()) + "]", doc);
  }
  void Numbers(const char* key, const std::vector<double>&, Bound bound, const char* doc) {
    Row(key, "list, each " + ToText(bound), "", doc);
  }
  template <typename Enum, std::size_t K>
  void Choice(const char* key, Enum value, const char* const (&names)[K], const char* doc) {
    std::string list;
    for (const char* name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    Row(key, list, names[static_cast<std::size_t>(value)], doc);
  }

 private:
  void Row(const char* key, const std::string& allowed, const std::string& standard, std::string doc) {
    for (std::size_t at = doc.find('|'); at != std::string::npos; at = doc.find('|', at + 2))
      doc.replace(at, 1, "\\|");
    out_ << "| " << section_ << '.' << key << " | " << allowed << " | " << standard << " | " << doc << " |\n";
  }
  std::ostringstream& out_;
  std::string section_;
};

template <typename Config>
void List(std::ostringstream& out, const char* section) {
  Config config;
  Lister lister(out, section);
  Fields(lister, config);
}

}  // namespace

std::string KeyReference() {
  std::ostringstream out;
  out << "| key | allowed | default | meaning |\n|---|---|---|---|\n";
  Scenario head;
  Lister lister(out, "scenario");
  ScenarioFields(lister, head);
  out << "| arm | name in config/arms, path, or the arm's table | | which arm |\n";
  List<PlantConfig>(out, "plant");
  List<DriveConfig>(out, "drives");
  List<SensorConfig>(out, "sensors");
  List<WallConfig>(out, "wall");
  List<DisturbanceConfig>(out, "disturbance");
  out << "| reference.start_rad | list, each -6.3 ... 6.3 rad | | motor-side joint angles at the start |\n";
  List<ReferenceLeg>(out, "reference.legs[]");
  List<ForceConfig>(out, "force");
  List<ControlConfig>(out, "control");
  List<LimitConfig>(out, "limits");
  List<TimingConfig>(out, "timing");
  List<CheckConfig>(out, "checks[]");
  return out.str();
}

}  // namespace reed
