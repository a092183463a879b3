// What the force sensor feels where it is mounted: it sits in the last link and carries the tool and the payload, as point
// masses.
//
//   F_s = R_sᵀ (F + Σ m (g - a)),   M_s = r_t x R_sᵀ F + Σ c x R_sᵀ m (g - a)      in its axes, about its origin
//
// with F the force of wall and disturbance on the tool point r_t, c where a mass is and a its acceleration, the mean over
// the last step. The payload is at the tool point. RT: safe.
#pragma once

#include <array>

#include "reed/plant/dynamics/equations_of_motion.h"

namespace reed::plant {

class MountedForceSensor {
 public:
  /// Keeps a reference to the chain.
  explicit MountedForceSensor(const ArmChain& chain)
      : chain_(chain), carried_{Carried{chain.force_sensor * chain.sensed_com}, Carried{chain.tool.p}} {
    carried_[kTool].mass = chain.sensed_mass;
  }

  void SetPayload(double mass_kg) { carried_[kPayload].mass = mass_kg; }
  /// The arm is at rest.
  void Rest() {
    for (Carried& mass : carried_) mass.acceleration.setZero();
  }
  /// Before and after a step of h seconds.
  void Begin(const EquationsOfMotion& state) {
    for (Carried& mass : carried_) mass.velocity = state.VelocityOf(mass.at);
  }
  void End(const EquationsOfMotion& state, double h) {
    for (Carried& mass : carried_) mass.acceleration = (state.VelocityOf(mass.at) - mass.velocity) / h;
  }

  Wrench Feel(const EquationsOfMotion& state, const Eigen::Vector3d& tip_force_N) const {
    const Placement& mount = chain_.force_sensor;
    const Eigen::Matrix3d to_sensor = (state.last_frame().R * mount.R).transpose();
    const auto from_origin = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
      return mount.R.transpose() * (at - mount.p);
    };
    Wrench felt;
    felt.force = to_sensor * tip_force_N;
    felt.moment = from_origin(chain_.tool.p).cross(felt.force);
    for (const Carried& mass : carried_) {
      const Eigen::Vector3d force = to_sensor * (mass.mass * (chain_.gravity - mass.acceleration));
      felt.force += force;
      felt.moment += from_origin(mass.at).cross(force);
    }
    return felt;
  }

 private:
  /// A point mass.
  struct Carried {
    Eigen::Vector3d at;  // last output frame
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(),
                    acceleration = Eigen::Vector3d::Zero();  // world frame
    double mass = 0.0;                                       // kg
  };
  static constexpr std::size_t kTool = 0, kPayload = 1;

  const ArmChain& chain_;
  std::array<Carried, 2> carried_;
};

}  // namespace reed::plant
