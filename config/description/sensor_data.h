// [sensors] what a data sheet says: known to the controller, true of the simulated sensors. RT: plain data.
#pragma once

namespace reed {

struct SensorData {
  bool wrench = true;                 // a wrist force sensor is fitted
  int encoder_bits = 20;              // per turn
  double velocity_filter_hz = 120.0;  // first-order low pass on the differentiated encoder
  double force_range_N = 200.0;       // beyond: saturated
  double force_noise_N = 0.05;        // standard deviation per axis
  double force_quantum_N = 0.01;      // step of the force reading
  double moment_range_Nm = 20.0;      // beyond: saturated
};

}  // namespace reed
