// Everything a controller may know before it starts: plain numbers of fixed size, no strings, no heap. Filled by
// firmware/setup from a configuration, or from an image on a target without files. RT: reading is safe.
#pragma once

#include "reed/core/contact/force_mode.h"
#include "reed/core/contact/force_source.h"
#include "reed/core/law/gains.h"
#include "reed/core/model/arm_model.h"
#include "reed/core/reference/force_profile.h"
#include "reed/core/safety/limits.h"
#include "reed/core/safety/monitors.h"
#include "reed/law_names/law_names.h"

namespace reed {

template <int N, int P>
struct Settings {
  model::ArmModel<N, P> arm;
  strategy::Gains<N, P> gains;
  strategy::LawId law = strategy::LawId::kSeparated;
  strategy::ForceModeConfig force_mode;
  reference::ForceProfile force;
  strategy::SourceSetting source = strategy::SourceSetting::kNone;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // outward, wall to robot, world frame
  double reach_m = 1.0;                               // of the arm, base to tool point
  double force_noise_N = 0.1;                         // of the force sensor, resolution included
  bool wall_present = false;                          // the arm is to expect a wall
  bool compensate_deflection = false;                 // θ_d after the static deflection (22)
  double velocity_filter_hz = 120.0;                  // of the drives
  protect::LimitValues<N> limits;
  protect::MonitorValues<N> monitors;
  bool monitored = true;  // false: nothing trips, for a bench that measures how long a hazard takes
  double rate_hz = 1000.0;
  double duration_s = 0.0;    // from the moment the arm is active
  bool start_wanted = false;  // the operator's wish to open the brakes

  double period_s() const noexcept { return 1.0 / rate_hz; }
};

}  // namespace reed
