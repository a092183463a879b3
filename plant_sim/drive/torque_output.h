// From a commanded to an applied torque: saturation, then the resolution of the drive's converter. RT: safe.
#pragma once

#include <algorithm>
#include <cmath>

namespace reed::plant {

/// Signed codes of `bits` bits over plus/minus `limit_Nm`, symmetric, so that zero and both limits are exact.
class TorqueOutput {
 public:
  TorqueOutput(double limit_Nm, int bits)
      : limit_Nm_(limit_Nm), lsb_Nm_(limit_Nm / (std::ldexp(1.0, bits - 1) - 1.0)) {}

  double lsb_Nm() const noexcept { return lsb_Nm_; }

  /// Pre: finite.
  double Apply(double torque_Nm) const noexcept {
    const double saturated_Nm = std::clamp(torque_Nm, -limit_Nm_, limit_Nm_);
    return std::nearbyint(saturated_Nm / lsb_Nm_) * lsb_Nm_;
  }

 private:
  double limit_Nm_;
  double lsb_Nm_;
};

}  // namespace reed::plant
