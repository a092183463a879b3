#include "reed/plant/faults/fault_checks.h"

#include <algorithm>
#include <sstream>

#include "reed/config/description/number_text.h"
#include "reed/plant/faults/kinds.h"
#include "reed/plant/faults/trigger.h"

namespace reed::plant {
namespace {

std::string Listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

std::string KindNames() {
  std::vector<std::string> names;
  for (const Kind* kind : AllKinds()) names.emplace_back(kind->name);
  return Listed(names);
}

/// What is wrong with one fault, in the order in which a reader would ask.
class Check {
 public:
  Check(const PlantConfig& config, const std::vector<FaultConfig>& faults, std::size_t number,
        double duration_s)
      : plant_(config), faults_(faults), f_(faults[number]), number_(number), duration_s_(duration_s) {}

  std::optional<FaultProblem> Run() {
    Identity();
    if (!found_) Place();
    if (!found_) Size();
    if (!found_) Start();
    if (!found_) Window();
    if (!found_) Contradiction();
    return found_;
  }

 private:
  void Refuse(const std::string& key, const std::string& text) {
    if (!found_) found_ = FaultProblem{number_, key, text};
  }

  void Identity() {
    if (f_.id.empty()) Refuse("id", "missing; a name, each once");
    for (std::size_t i = 0; i < number_; ++i)
      if (faults_[i].id == f_.id) Refuse("id", "'" + f_.id + "' is another fault's too; each once");
  }

  void Place() {
    kind_ = FindKind(f_.kind);
    if (kind_ == nullptr) return Refuse("kind", "'" + f_.kind + "' is unknown; allowed: " + KindNames());
    const auto target = ParseTarget(f_.target);
    if (!target || !Fits(kind_->seats, target->seat))
      return Refuse("target", "'" + f_.target + "' " + (target ? "cannot have" : "is unknown to") +
                                  " the kind " + f_.kind + "; allowed: " + TargetNames(kind_->seats));
    target_ = *target;
    if (target_.joint >= plant_.arm.dof())
      return Refuse("target",
                    "'" + f_.target + "': the arm has " + std::to_string(plant_.arm.dof()) + " joints");
    const bool wrench = target_.seat == Seat::kForce || target_.seat == Seat::kWrenchFrame;
    if (wrench && !plant_.sensors.wrench)
      Refuse("target", "'" + f_.target + "': no force sensor is fitted (sensors.wrench)");
    if (std::string_view(kind_->unit) == "joint" && f_.size > plant_.arm.dof())
      Refuse("size", "joint " + ToText(f_.size) + ": the arm has " + std::to_string(plant_.arm.dof()));
  }

  void Size() {
    if (kind_->unit[0] == '\0') {
      if (f_.size != 0.0) Refuse("size", "the kind " + f_.kind + " has no size");
      return;
    }
    if (f_.size != 0.0 && (f_.size < kind_->lo || f_.size > kind_->hi))
      Refuse("size", ToText(f_.size) + " is out of range; allowed: " + ToText(kind_->lo) + " ... " +
                         ToText(kind_->hi) + " " + kind_->unit);
    if (f_.size != 0.0 && f_.size == kind_->neutral) Refuse("size", ToText(f_.size) + " changes nothing");
  }

  void Start() {
    const int ways = (f_.from_s >= 0.0 ? 1 : 0) + (f_.from_cycle >= 0 ? 1 : 0) +
                     (f_.from_mode.empty() ? 0 : 1) + (f_.from_event.empty() ? 0 : 1) +
                     (f_.signal.empty() ? 0 : 1);
    if (ways != 1)
      return Refuse("from_s", std::string(ways == 0 ? "nothing starts it" : "more than one thing starts it") +
                                  "; give one of from_s, from_cycle, from_mode, from_event, signal");
    if (!f_.from_mode.empty() && DriveStateNamed(f_.from_mode) < 0)
      Refuse("from_mode",
             "'" + f_.from_mode + "' is no state of drives; allowed: off, ready, enabled, braked, fault");
    if (!f_.signal.empty() && !Signal::Known(f_.signal, plant_.arm.dof()))
      Refuse("signal", "'" + f_.signal +
                           "' is unknown to this arm; allowed: normal_force_N, gap_m, tip_speed_mps, "
                           "jointN.angle_rad, jointN.speed_radps");
    if (!f_.from_event.empty()) StartByEvent();
    if (duration_s_ > 0.0 && std::max(f_.from_s, 0.0) + f_.delay_s >= duration_s_)
      Refuse(f_.from_s >= 0.0 ? "from_s" : "delay_s", ToText(std::max(f_.from_s, 0.0) + f_.delay_s) +
                                                          " s is not before the run's end at " +
                                                          ToText(duration_s_) + " s; it would never begin");
    const bool wall =
        f_.signal == "normal_force_N" || f_.signal == "gap_m" || f_.from_event.starts_with("contact_");
    if (wall && !plant_.wall.present)
      Refuse(f_.signal.empty() ? "from_event" : "signal",
             "there is no wall (wall.present); it would never begin");
  }

  void StartByEvent() {
    const bool happening =
        std::find(kHappenings.begin(), kHappenings.end(), f_.from_event) != kHappenings.end();
    const bool other = std::any_of(faults_.begin(), faults_.end(), [&](const FaultConfig& g) {
      return g.id == f_.from_event && g.id != f_.id;
    });
    if (!happening && !other)
      Refuse("from_event", "'" + f_.from_event +
                               "' is no event and no other fault's id; allowed: contact_made, contact_lost, "
                               "brakes_released, brakes_closed, an id");
  }

  void Window() {
    if (f_.duration_s > 0.0 && f_.duration_s * plant_.timing.rate_hz < 0.5)
      Refuse("duration_s",
             ToText(f_.duration_s) + " s is less than half a period; it would not act in any cycle");
    if (f_.probability == 0.0) Refuse("probability", "0: it would never act");
  }

  /// Two faults that say what one value is: which of them counts, nobody could say.
  void Contradiction() {
    for (std::size_t i = 0; i < number_; ++i) {
      const FaultConfig& other = faults_[i];
      const Kind* kind = FindKind(other.kind);
      const auto target = ParseTarget(other.target);
      if (kind == nullptr || !target || target->seat != target_.seat) continue;
      const bool same = target->joint == target_.joint || target->joint < 0 || target_.joint < 0;
      const bool axes = target->axis == target_.axis || target->axis < 0 || target_.axis < 0;
      const bool exclusive = kind->fixes || kind_->fixes || kind == kind_;
      if (same && axes && exclusive && MayOverlap(other))
        Refuse("target", "contradicts the fault '" + other.id + "' (" + other.kind + " of " + other.target +
                             ") on the same element at the same time");
    }
  }

  bool MayOverlap(const FaultConfig& other) const {
    if (f_.from_s < 0.0 || other.from_s < 0.0) return true;
    const auto end = [](const FaultConfig& f) {
      return f.duration_s > 0.0 ? f.from_s + f.delay_s + f.duration_s : 1e12;
    };
    return f_.from_s + f_.delay_s < end(other) && other.from_s + other.delay_s < end(f_);
  }

  const PlantConfig& plant_;
  const std::vector<FaultConfig>& faults_;
  const FaultConfig& f_;
  std::size_t number_;
  double duration_s_;
  const Kind* kind_ = nullptr;
  Target target_;
  std::optional<FaultProblem> found_;
};

}  // namespace

std::vector<FaultConfig> FaultsOf(const PlantConfig& config) {
  std::vector<FaultConfig> faults = config.faults;
  const SensorConfig& sensors = config.sensors;
  if (!sensors.wrench || sensors.wrench_lost_from_s < 0.0) return faults;
  FaultConfig lost;
  lost.id = "wrench_lost";
  lost.target = "wrench.frame";
  lost.kind = "silent";
  lost.from_s = sensors.wrench_lost_from_s;
  if (sensors.wrench_lost_to_s >= 0.0)
    lost.duration_s = sensors.wrench_lost_to_s - sensors.wrench_lost_from_s;
  faults.push_back(lost);
  return faults;
}

std::optional<FaultProblem> FindProblem(const PlantConfig& config, double duration_s) {
  const std::vector<FaultConfig> faults = FaultsOf(config);
  for (std::size_t i = 0; i < config.faults.size(); ++i)
    if (auto found = Check(config, faults, i, duration_s).Run()) return found;
  return std::nullopt;
}

std::string FaultKindTable() {
  std::ostringstream out;
  out << "| kind | targets | size, usual | what happens |\n|---|---|---|---|\n";
  for (const Kind* kind : AllKinds())
    out << "| " << kind->name << " | " << TargetNames(kind->seats) << " | "
        << (kind->unit[0] == '\0' ? std::string() : std::string(kind->unit) + ", " + ToShortText(kind->usual))
        << " | " << kind->text << " |\n";
  return out.str();
}

}  // namespace reed::plant
