#include "reed/config/schema/scenario_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "reed/config/schema/allowed.h"
#include "reed/config/schema/arm_file.h"
#include "reed/config/schema/reader.h"
#include "reed/config/schema/rigid_pose.h"
#include "reed/config/schema/rules.h"
#include "reed/config/schema/scenario_fields.h"
#include "reed/config/schema/true_parameters.h"

namespace reed {
namespace {

toml::table* Section(Document& doc, const std::string& name) {
  toml::node* node = doc.root().get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) doc.Fail(node, name, "expected a section [" + name + "]");
  return node->as_table();
}

template <typename Config>
void ReadSection(Document& doc, const std::string& name, Config& config) {
  Reader reader(doc, Section(doc, name), name);
  Fields(reader, config);
  reader.RefuseUnknown();
}

template <typename Item>
void ReadList(Document& doc, toml::node* node, const std::string& name, std::vector<Item>& items) {
  if (node == nullptr) return;
  toml::array* array = node->as_array();
  if (array == nullptr) doc.Fail(node, name, "expected a list of tables [[" + name + "]]");
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string key = name + "[" + std::to_string(i) + "]";
    toml::table* table = (*array)[i].as_table();
    if (table == nullptr) doc.Fail(&(*array)[i], key, "expected a table");
    Reader reader(doc, table, key);
    Item item;
    Fields(reader, item);
    reader.RefuseUnknown();
    items.push_back(item);
  }
}

void ReadReference(Document& doc, ReferenceConfig& reference) {
  Reader reader(doc, Section(doc, "reference"), "reference");
  Fields(reader, reference);
  ReadList(doc, reader.Get("legs"), "reference.legs", reference.legs);
  reader.RefuseUnknown();
}

/// A path in a file is relative to that file. One from the time when it was relative to the working directory still
/// means that, where it names no file beside its own.
std::string BesideFile(const Document& doc, const std::string& path) {
  const std::filesystem::path beside = std::filesystem::path(doc.path()).parent_path() / path;
  std::error_code ec;
  return std::filesystem::exists(beside, ec) || !std::filesystem::exists(path, ec) ? beside.string() : path;
}

/// [arm] is a name, a path, or the whole description inline (as in effective.toml).
void ResolveArm(Document& doc, const std::string& wanted) {
  toml::node* node = doc.root().get("arm");
  if (wanted.empty() && node != nullptr && node->is_table()) return;
  std::string name = wanted;
  if (name.empty()) {
    if (node == nullptr) doc.Fail(nullptr, "arm", "missing; a name in config/arms or a path");
    if (!node->is_string()) doc.Fail(node, "arm", "expected a name in config/arms or a path");
    name = *node->value<std::string>();
  }
  std::string path;
  try {
    path = FindConfig("arms", name);
    if (wanted.empty() && path == name) path = BesideFile(doc, name);
    std::error_code ec;
    if (!std::filesystem::is_regular_file(path, ec))
      throw ConfigError(path + ": no such file; allowed: a name in config/arms, or a path to a file");
  } catch (const ConfigError& error) {
    if (wanted.empty()) doc.Fail(node, "arm", error.what());
    throw ConfigError(std::string("--arm ") + wanted + ": " + error.what());
  }
  Document arm = Document::Load(path);
  if (!arm.root().contains("name")) arm.root().insert("name", arm.stem());
  doc.Graft("arm", std::move(arm));
}

void RefuseUnknownSections(Document& doc) {
  const std::vector<std::string> sections{"scenario", "arm",         "plant",     "drives", "sensors",
                                          "wall",     "disturbance", "reference", "force",  "control",
                                          "limits",   "timing",      "link",      "fault",  "checks"};
  for (const auto& [key, node] : doc.root()) {
    if (std::find(sections.begin(), sections.end(), key.str()) != sections.end()) continue;
    const std::string word(key.str());
    doc.Fail(&node, word, "unknown section; " + Allowed(word, sections));
  }
}

/// One number for all joints becomes one per joint.
void Spread(std::vector<double>& list, int dof) {
  if (list.size() == 1) list.assign(static_cast<std::size_t>(dof), list[0]);
}

/// The truth of an arm has a place of its own; the old keys mean that. Friction at its old place is declared, too.
void Override(Document& doc, const std::string& assignment) {
  constexpr std::pair<const char*, const char*> kMoved[] = {{"arm.p_true", "arm.truth.p"},
                                                            {"arm.coulomb", "arm.truth.coulomb"},
                                                            {"arm.coulomb", "arm.coulomb_declared"},
                                                            {"arm.bodies", "arm.truth.bodies"}};
  const std::string typed = assignment.substr(0, assignment.find('='));
  bool moved = false;
  for (const auto& [old_key, key] : kMoved) {
    const std::string rest = assignment.substr(std::min(assignment.size(), std::strlen(old_key)));
    const bool means_it = assignment.starts_with(old_key) && (rest.starts_with("=") || rest.starts_with("."));
    if (!means_it || doc.root().at_path(old_key) || !doc.root().at_path("arm.truth")) continue;
    doc.Override(key + rest, typed);
    moved = true;
  }
  if (!moved) doc.Override(assignment, typed);
}

/// start_tip_m -> start_rad. Half a margin more than the reference must keep, so that it can move from there.
void FindStart(Document& doc, Scenario& s) {
  ReferenceConfig& reference = s.reference;
  const std::vector<double>& tip = reference.start_tip_m;
  if (tip.empty()) return;
  const auto refuse = [&](const std::string& problem) {
    doc.Fail(doc.root().at_path("reference.start_tip_m").node(), "reference.start_tip_m", problem);
  };
  if (tip.size() != 3) refuse("expected [x, y, z] in m, world frame");
  const bool near = !reference.start_rad.empty();
  if (near && reference.start_rad.size() != s.arm.joints.size()) return;  // a rule says so
  reference.start_rad = StartAnglesFor(s.arm, Eigen::Map<const Eigen::Vector3d>(tip.data()),
                                       reference.start_rad, 1.5 * s.limits.position_margin_rad);
  if (reference.start_rad.empty())
    refuse("no joint angles within their limits bring the tool point there" +
           std::string(near ? " from reference.start_rad" : "") + "; the arm reaches " +
           ToShortText(s.arm.reach_m()) + " m from its base");
  reference.start_tip_m.clear();
}

}  // namespace

Scenario LoadScenario(const std::string& name_or_path, const LoadOptions& options, Wanted wanted,
                      const std::vector<FurtherCheck>& further) {
  Document doc = Document::Load(FindConfig("scenarios", name_or_path));
  ResolveArm(doc, options.arm);
  for (const std::string& assignment : options.set) Override(doc, assignment);
  RefuseUnknownSections(doc);

  Scenario s;
  Reader head(doc, Section(doc, "scenario"), "scenario");
  ScenarioFields(head, s);
  head.RefuseUnknown();
  if (s.name.empty()) s.name = doc.stem();
  s.arm = ReadArm(doc, *Section(doc, "arm"), "arm");
  ReadSection(doc, "plant", s.plant);
  ReadSection(doc, "drives", s.drives);
  ReadSection(doc, "sensors", s.sensors);
  ReadSection(doc, "wall", s.wall);
  ReadSection(doc, "disturbance", s.disturbance);
  ReadSection(doc, "link", s.link);
  ReadReference(doc, s.reference);
  ReadSection(doc, "force", s.force);
  ReadSection(doc, "control", s.control);
  ReadSection(doc, "limits", s.limits);
  ReadSection(doc, "timing", s.timing);
  ReadList(doc, doc.root().get("fault"), "fault", s.faults);
  ReadList(doc, doc.root().get("checks"), "checks", s.checks);

  Spread(s.control.K_d, s.arm.dof());
  Spread(s.control.Lambda, s.arm.dof());
  Spread(s.reference.start_rad, s.arm.dof());
  FindStart(doc, s);
  const bool has_law = wanted == Wanted::kWhole || doc.root().contains("control");
  CheckRules(doc, s, has_law);
  if (!s.plant.p_true.empty()) SetTrueParameters(s.arm, s.plant.p_true);
  s.wall.normal.normalize();
  for (const FurtherCheck& check : further)
    if (const auto found = check(s)) doc.Fail(doc.root().at_path(found->key).node(), found->key, found->text);
  return s;
}

}  // namespace reed
