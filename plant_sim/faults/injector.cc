#include "reed/plant/faults/injector.h"

#include <algorithm>

#include "reed/bus/transport/forwarding_transport.h"
#include "reed/plant/drive/drive_state.h"
#include "reed/plant/faults/fault_checks.h"
#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

/// A stream of its own by the fault's name: another fault in the file shifts nothing (FNV-1a).
std::uint32_t StreamOf(const std::string& id) {
  std::uint32_t hash = 2166136261U;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return std::max(hash, stream::kFault);
}

}  // namespace

struct Injector::Entry {
  const FaultConfig* config;
  Trigger trigger;
  RandomStream random;
  std::unique_ptr<Fault> fault;
  bool window = false, acts = false, pending = false;
};

/// The arm under the drives: torques and brakes pass the faults.
class Injector::Body final : public ArmBody {
 public:
  Body(Injector& faults, ArmBody& body, const std::vector<double>& limit_Nm)
      : faults_(faults),
        body_(body),
        limit_Nm_(
            Eigen::Map<const Eigen::VectorXd>(limit_Nm.data(), static_cast<Eigen::Index>(limit_Nm.size()))),
        torque_Nm_(limit_Nm_) {}

  void Reset(const Eigen::VectorXd& motor_angle_rad) override {
    body_.ForceBrakes(0, 0);
    body_.Reset(motor_angle_rad);
  }
  void Advance(const Eigen::VectorXd& motor_torque_Nm, bool braked, double dt_s) override {
    torque_Nm_ = motor_torque_Nm;
    Actuation act{torque_Nm_, limit_Nm_, body_.truth().motor_speed_radps};
    act.braked = braked;
    faults_.ForActing(false, [&](Fault& fault, const Moment& at) { fault.OnActuation(act, at); });
    body_.ForceBrakes(act.brakes_closed, act.brakes_open);
    body_.Advance(torque_Nm_, braked, dt_s);
  }
  void StartSchedule() override { body_.StartSchedule(); }
  const Truth& truth() const override { return body_.truth(); }
  const ArmShape& Shape() override { return body_.Shape(); }
  bool healthy() const override { return body_.healthy(); }
  std::string fault_description() const override { return body_.fault_description(); }

 private:
  Injector& faults_;
  ArmBody& body_;
  Eigen::VectorXd limit_Nm_, torque_Nm_;
};

/// The bus behind the port: frames of both directions pass the faults.
class Injector::Wire final : public bus::ForwardingTransport {
 public:
  Wire(Injector& faults, bus::Transport& transport) : bus::ForwardingTransport(transport), faults_(faults) {}

  int Receive(std::span<bus::Frame> out, int wanted, std::int64_t deadline_ns) noexcept override {
    const int count = ForwardingTransport::Receive(out, wanted, deadline_ns);
    batch_.Clear();
    for (const bus::Frame& frame : out.first(static_cast<std::size_t>(count))) {
      if (frame.id == bus::layout::kSync.id) faults_.NoteSync();
      batch_.Add(frame);
    }
    faults_.ForActing(true, [&](Fault& fault, const Moment& at) { fault.OnReceived(batch_, at); });
    const auto passed = batch_.frames().first(std::min(batch_.size(), out.size()));
    std::copy(passed.begin(), passed.end(), out.begin());
    return static_cast<int>(passed.size());
  }
  int Send(std::span<const bus::Frame> frames) noexcept override {
    batch_.Clear();
    batch_.Add(frames);
    faults_.ForActing(true, [&](Fault& fault, const Moment& at) { fault.OnSent(batch_, at); });
    ForwardingTransport::Send(batch_.frames());
    return static_cast<int>(frames.size());
  }

 private:
  Injector& faults_;
  FrameBatch batch_;
};

std::unique_ptr<Injector> Injector::For(const PlantConfig& config, ArmBody& body, bus::Transport& transport) {
  std::vector<FaultConfig> faults = FaultsOf(config);
  if (faults.empty()) return nullptr;
  if (const auto problem = FindProblem(config))
    throw ConfigError("fault '" + faults[problem->fault].id + "': " + problem->key + ": " + problem->text);
  return std::make_unique<Injector>(std::move(faults), config, body, transport);
}

Injector::Injector(std::vector<FaultConfig> faults, const PlantConfig& config, ArmBody& body,
                   bus::Transport& transport)
    : configs_(std::move(faults)),
      seed_(config.seed),
      period_s_(1.0 / config.timing.rate_hz),
      rate_hz_(config.timing.rate_hz),
      filter_hz_(config.sensors.velocity_filter_hz),
      changes_(2 * configs_.size()),
      begun_(configs_.size()),
      speeds_(static_cast<std::size_t>(config.arm.dof()), VelocityFilter(filter_hz_)),
      body_(std::make_unique<Body>(*this, body, config.arm.torque_limit_Nm)),
      wire_(std::make_unique<Wire>(*this, transport)) {
  Reset();
}

Injector::~Injector() = default;
ArmBody& Injector::body() noexcept { return *body_; }
bus::Transport& Injector::transport() noexcept { return *wire_; }

void Injector::Reset() {
  entries_.clear();
  encoders_ = 0;
  for (const FaultConfig& config : configs_) {
    const Kind* kind = FindKind(config.kind);
    const Making making{config, *ParseTarget(config.target), config.size != 0.0 ? config.size : kind->usual};
    entries_.push_back({&config, Trigger(config, configs_, rate_hz_),
                        RandomStream(seed_, StreamOf(config.id)), kind->make(making)});
    if (making.target.seat == Seat::kEncoder)
      encoders_ |= making.target.joint < 0 || kind->seats == (Seat::kEncoder | Seat::kForce)
                       ? ~0U
                       : 1U << static_cast<unsigned>(making.target.joint);
  }
  sampled_s_ = 0.0;
  fresh_ = true;
  contact_ = false;
  braked_ = true;
  cycle_ = 0;
  begun_.assign(configs_.size(), false);
}

void Injector::Step(std::int64_t cycle, double time_s, double enabled_for_s, bus::DriveState drives,
                    Measurement& m) noexcept {
  cycle_ = std::max(cycle_, cycle);  // a SYNC that was held back is no way back
  const Scene scene = Look(cycle_, enabled_for_s, drives);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const bool was = entries_[i].window;
    Decide(entries_[i], entries_[i].trigger.Step(scene));
    begun_[i] = entries_[i].window && !was;  // those before this one in the list see it in the next cycle
  }
  if (fresh_) KeepSpeeds(m);
  ForActing(false, [&](Fault& fault, const Moment& at) { fault.OnMeasurement(m, at); });
  FollowEncoders(m, time_s - sampled_s_);
  sampled_s_ = time_s;
  fresh_ = false;
}

Scene Injector::Look(std::int64_t cycle, double enabled_for_s, bus::DriveState drives) noexcept {
  Scene scene{cycle, enabled_for_s, drives, 0, begun_, body_->truth()};
  const bool contact = scene.truth.gap_m < 0.0, braked = BrakesClosed(drives);
  const auto note = [&](bool now, Happening what) {
    if (now) scene.happened |= static_cast<std::uint8_t>(what);
  };
  note(contact && !contact_, Happening::kContactMade);
  note(!contact && contact_, Happening::kContactLost);
  note(!braked && braked_, Happening::kBrakesReleased);
  note(braked && !braked_, Happening::kBrakesClosed);
  contact_ = contact;
  braked_ = braked;
  return scene;
}

/// Of a SYNC that faults may keep from the arm: their windows end all the same.
void Injector::NoteSync() noexcept {
  ++cycle_;
  for (Entry& entry : entries_)
    if (entry.window) Decide(entry, entry.trigger.Pass(cycle_));
}

void Injector::Decide(Entry& entry, bool acts) noexcept {
  const auto number = static_cast<std::size_t>(&entry - entries_.data());
  const FaultConfig& config = *entry.config;
  if (acts != entry.window && num_changes_ < changes_.size())
    changes_[num_changes_++] = {number, config.id.c_str(), config.kind.c_str(), config.target.c_str(), acts};
  if (!acts && entry.window) {
    entry.fault->End();
    entry.pending = entry.fault->pending();
  }
  entry.window = acts;
  entry.acts = acts && (config.probability >= 1.0 || entry.random.Uniform() <= config.probability);
}

template <typename Call>
void Injector::ForActing(bool pending_too, Call call) noexcept {
  for (Entry& entry : entries_)
    if (entry.acts || (pending_too && entry.pending))
      call(*entry.fault, Moment{cycle_, entry.trigger.since(), period_s_, entry.random});
}

void Injector::KeepSpeeds(Measurement& m) noexcept {
  for (std::size_t i = 0; i < speeds_.size(); ++i) speeds_[i].Reset(m.joints[i].position_rad);
}

void Injector::FollowEncoders(Measurement& m, double dt_s) noexcept {
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    if ((encoders_ >> i & 1U) == 0) continue;
    speeds_[i].Update(m.joints[i].position_rad, dt_s);
    m.joints[i].velocity_radps = speeds_[i].speed_radps();
  }
}

}  // namespace reed::plant
