#include "reed/plant/endpoint/robot.h"

#include <algorithm>
#include <span>
#include <utility>

#include "reed/plant/drive/drive_state.h"

namespace reed::plant {
namespace {

double Fastest(const Eigen::VectorXd& speed_radps) { return speed_radps.cwiseAbs().maxCoeff(); }

}  // namespace

Robot::Robot(const PlantConfig& config, ArmBody& body, Journal& journal)
    : body_(body),
      journal_(journal),
      start_rad_(Eigen::Map<const Eigen::VectorXd>(config.start_rad.data(), config.arm.dof())),
      drives_(config.arm, config.drives),
      excitation_(config.drives),
      speeds_(static_cast<std::size_t>(config.arm.dof()), VelocityFilter(config.sensors.velocity_filter_hz)),
      wrench_(config.sensors, config.seed) {
  for (int i = 0; i < config.arm.dof(); ++i)
    encoders_.emplace_back(config.sensors.encoder_bits, config.sensors.encoder_noise_rad, config.seed, i);
  Reset();
}

void Robot::Reset() {
  body_.Reset(start_rad_);
  drives_.Reset();
  excited_Nm_ = drives_.torque_Nm();  // its size, so that Advance allocates nothing
  wrench_.Reset();
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    encoders_[i].Reset();
    speeds_[i].Reset(encoders_[i].Read(start_rad_[static_cast<Eigen::Index>(i)]));
  }
  time_s_ = 0.0;
  sampled_s_ = 0.0;
  enabled_s_ = -1.0;
  request_ = bus::DriveRequest::kOff;
  in_contact_ = body_.truth().gap_m < 0.0;
}

Measurement Robot::Measure() {
  const Truth& truth = body_.truth();
  Measurement m;
  m.dof = static_cast<int>(speeds_.size());
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double reading_rad = encoders_[i].Read(truth.motor_angle_rad[row]);
    speeds_[i].Update(reading_rad, time_s_ - sampled_s_);
    m.joints[i].position_rad = reading_rad;
    m.joints[i].velocity_radps = speeds_[i].speed_radps();
    m.joints[i].torque_Nm = drives_.torque_Nm()[row];
    m.joints[i].state = drives_.state();
  }
  sampled_s_ = time_s_;
  m.wrench = wrench_.Measure(truth.sensed_force_N, truth.sensed_moment_Nm);
  m.wrench_lost = !wrench_.fitted();
  return m;
}

bool Robot::Command(const bus::CommandMessage& command) {
  const bus::DriveState before = drives_.state();
  const double fastest_radps = Fastest(body_.truth().motor_speed_radps);
  if (!drives_.Command(command.request, command.torque_Nm, fastest_radps)) return false;
  const bool asked = command.request == bus::DriveRequest::kEnable && request_ != command.request;
  request_ = command.request;
  if (asked && drives_.braked()) {
    journal_.Note(PlantEvent::kEnableRefused, drives_.state(), fastest_radps,
                  "enable refused at %.3f s: drives %s, fastest motor %.3f rad/s (needs ready, then enable, "
                  "at rest below "
                  "%.2f rad/s)",
                  time_s_, Name(before), fastest_radps, kRestSpeed_radps);
  }
  NoteDriveChange(before);
  return true;
}

void Robot::Silence(double periods) {
  const bus::DriveState before = drives_.state();
  drives_.Silence(periods);
  NoteDriveChange(before);
}

void Robot::Advance(double dt_s) {
  const bool excited = excitation_.active() && !drives_.braked();
  if (excited) {
    excited_Nm_ = drives_.torque_Nm();
    excited_Nm_[excitation_.joint()] += excitation_.At(time_s_);
  }
  body_.Advance(excited ? std::as_const(excited_Nm_) : drives_.torque_Nm(), drives_.braked(), dt_s);
  time_s_ += dt_s;
  if (!body_.healthy()) {
    const bus::DriveState before = drives_.state();
    drives_.Fault();
    NoteDriveChange(before);
  }
  NoteContactChange();
}

PlantRecord Robot::Snapshot(const HostPauses& host) const {
  const Truth& truth = body_.truth();
  PlantRecord out;
  out.dof = static_cast<std::int32_t>(speeds_.size());
  REED_PLANT_T(REED_SET)
  return out;
}

ShapeRecord Robot::ShapeSnapshot() {
  const ArmShape& shape = body_.Shape();
  const std::size_t last = shape.bent.size() - 1;
  const std::size_t stride = (last + kMaxShapePoints - 2) / (kMaxShapePoints - 1);
  ShapeRecord r;
  const auto add = [&](std::size_t from) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      r.bent[axis][r.num] = static_cast<float>(shape.bent[from][row]);
      r.rigid[axis][r.num] = static_cast<float>(shape.rigid[from][row]);
    }
    ++r.num;
  };
  for (std::size_t k = 0; k < last; k += stride) add(k);
  add(last);  // the tool point, always
  return r;
}

void Robot::NoteDriveChange(bus::DriveState before) {
  const bus::DriveState now = drives_.state();
  if (now == before) return;
  if (now == bus::DriveState::kEnabled) {
    enabled_s_ = time_s_;
    body_.StartSchedule();
  }
  journal_.Note(PlantEvent::kDriveState, now, static_cast<double>(now), "drives %s -> %s at %.3f s",
                Name(before), Name(now), time_s_);
  if (BrakesClosed(now) != BrakesClosed(before)) {
    journal_.Note(BrakesClosed(now) ? PlantEvent::kBrakesClosed : PlantEvent::kBrakesReleased, now, time_s_,
                  "brakes %s at %.3f s", BrakesClosed(now) ? "closed" : "released", time_s_);
  }
}

void Robot::NoteContactChange() {
  const bool contact = body_.truth().gap_m < 0.0;
  if (contact == in_contact_) return;
  in_contact_ = contact;
  journal_.Note(contact ? PlantEvent::kContactMade : PlantEvent::kContactLost, drives_.state(),
                body_.truth().normal_force_N, "contact %s at %.3f s", contact ? "made" : "lost", time_s_);
}

}  // namespace reed::plant
