#include "reed/inspect/modes_query.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "reed/inspect/named_values.h"
#include "reed/plant/dynamics/modes.h"

namespace reed::inspect {
namespace {

using Json = nlohmann::ordered_json;

Json FirstOf(const std::vector<double>& frequencies, int modes) {
  const auto count = std::min<std::ptrdiff_t>(modes, std::ssize(frequencies));
  return std::vector<double>(frequencies.begin(), frequencies.begin() + count);
}

Json Line(const std::vector<Eigen::Vector3d>& points) {
  Json line = Json::array();
  for (const Eigen::Vector3d& point : points) line.push_back({point.x(), point.y(), point.z()});
  return line;
}

double Number(const std::string& key, const std::string& text) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value)) {
    throw CaseError("--beam: " + key + ": expected a finite number, not '" + text + "'");
  }
  return value;
}

}  // namespace

BeamQuery ParseBeam(const std::string& text) {
  BeamQuery beam;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t sign = item.find('=');
    const std::string key = item.substr(0, sign);
    const double value = Number(key, sign == std::string::npos ? "" : item.substr(sign + 1));
    if (key == "length") {
      beam.length_m = value;
    } else if (key == "EI") {
      beam.EI_Nm2 = value;
    } else if (key == "rhoA") {
      beam.rhoA_kgpm = value;
    } else if (key == "tip_mass") {
      beam.tip_mass_kg = value;
    } else if (key == "elements") {
      beam.elements = value;
    } else {
      throw CaseError("--beam: '" + key + "' is not known; allowed: length, EI, rhoA, tip_mass, elements");
    }
  }
  if (!(beam.length_m > 0.0 && beam.EI_Nm2 > 0.0 && beam.rhoA_kgpm > 0.0 && beam.tip_mass_kg >= 0.0)) {
    throw CaseError("--beam: length, EI and rhoA must be given and positive, tip_mass not negative");
  }
  if (!(beam.elements >= 1.0 && beam.elements <= 100.0 && beam.elements == std::floor(beam.elements))) {
    throw CaseError("--beam: elements must be a whole number, 1 ... 100");
  }
  return beam;
}

void WriteBeamModes(std::ostream& out, const BeamQuery& beam, int modes) {
  const auto frequencies = plant::BeamModes(beam.length_m, beam.EI_Nm2, beam.rhoA_kgpm, beam.tip_mass_kg,
                                            static_cast<int>(beam.elements));
  out << Json{{"freq_hz", FirstOf(frequencies, modes)}}.dump() << '\n';
}

void WriteArmModes(std::ostream& out, const ArmDescription& arm, const std::vector<double>& q, int modes) {
  Eigen::VectorXd motors = Eigen::VectorXd::Zero(arm.dof());
  if (!q.empty()) {
    if (std::ssize(q) != arm.dof())
      throw CaseError("--at: expected " + std::to_string(arm.dof()) + " angles in rad");
    motors = Eigen::Map<const Eigen::VectorXd>(q.data(), std::ssize(q));
    if (!motors.allFinite()) throw CaseError("--at: expected finite angles in rad");
  }
  plant::ArmModes bent(TrueOf(arm), PlantModelConfig{}, motors);
  bent.Load(Eigen::Vector3d::Zero(), true);
  Json result;
  result["arm"] = arm.name;
  result["q"] = std::vector<double>(motors.begin(), motors.end());
  result["freq_hz"] = FirstOf(bent.frequency_hz(), modes);
  result["undeformed_m"] = Line(bent.Undeformed());
  result["deformed_m"] = Line(bent.Deformed());
  result["nodes_m"] = Line(bent.Undeformed(0));
  result["nodes_deformed_m"] = Line(bent.Deformed(0));
  result["mode_shapes"] = Json::array();
  for (int k = 0; k < static_cast<int>(result["freq_hz"].size()); ++k) {
    result["mode_shapes"].push_back(Line(bent.ModeShape(k)));
  }
  out << result.dump() << '\n';
}

}  // namespace reed::inspect
