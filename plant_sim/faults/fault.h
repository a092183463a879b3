// What a kind of fault is. A cycle passes a fault in this order: a SYNC and commands come off the bus, drives and brakes act on
// the arm, sensors read it, frames go out. A kind changes what it is about and leaves the rest alone. RT: safe.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>

#include "reed/bus/frame/frame.h"
#include "reed/config/plant/fault_config.h"
#include "reed/plant/faults/frame_batch.h"
#include "reed/plant/faults/target.h"
#include "reed/plant/sensor/measurement.h"
#include "reed/plant/sensor/random_stream.h"

namespace reed::plant {

/// When a fault acts, and its own random numbers.
struct Moment {
  std::int64_t cycle = 0;  // of the present SYNC
  int since = 0;           // cycles since the fault began: 0 in the first
  double period_s = 1e-3;
  RandomStream& random;

  double since_s() const noexcept { return since * period_s; }
};

/// What drives and brakes do to the arm until the next look.
struct Actuation {
  int dof() const noexcept { return static_cast<int>(torque_Nm.size()); }

  Eigen::VectorXd& torque_Nm;
  const Eigen::VectorXd& limit_Nm;
  const Eigen::VectorXd& motor_speed_radps;
  std::uint32_t brakes_closed = 0, brakes_open = 0;  // a bit per joint: stuck so, whatever the drives want
  bool braked = false;                               // the drives' own wish
};

/// What a kind is made from.
struct Making {
  const FaultConfig& config;
  Target target;
  double size;  // the configuration's, or the usual one
};

class Fault {
 public:
  explicit Fault(const Making& making) noexcept
      : target_(making.target), size_(making.size), announced_(making.config.announced) {}
  Fault(const Fault&) = delete;
  Fault& operator=(const Fault&) = delete;
  virtual ~Fault() = default;
  virtual void OnReceived(FrameBatch&, const Moment&) noexcept {}
  virtual void OnActuation(Actuation&, const Moment&) noexcept {}
  virtual void OnMeasurement(Measurement&, const Moment&) noexcept {}
  virtual void OnSent(FrameBatch&, const Moment&) noexcept {}
  /// The window is over.
  virtual void End() noexcept {}
  /// Its frames are still to be passed to it then, because it holds some back.
  virtual bool pending() const noexcept { return false; }

 protected:
  const Target& target() const noexcept { return target_; }
  double size() const noexcept { return size_; }
  bool announced() const noexcept { return announced_; }
  bool Hits(const bus::Frame& frame) const noexcept { return target_.Carries(frame.id); }

 private:
  Target target_;
  double size_;
  bool announced_;
};

/// One row of the table of kinds (kinds.cc).
struct Kind {
  const char* name;
  std::uint32_t seats;  // where it may sit
  const char* unit;     // of size; "": it has none
  double usual;         // size where none is given
  double lo, hi;        // of size
  bool fixes;           // its target's value is its own, so no other fault may sit there at the same time
  const char* text;     // for people
  std::unique_ptr<Fault> (*make)(const Making&);
  double neutral = 0.0;  // a size that changes nothing; 0: none is
};

template <typename T>
std::unique_ptr<Fault> Make(const Making& making) {
  return std::make_unique<T>(making);
}

}  // namespace reed::plant
