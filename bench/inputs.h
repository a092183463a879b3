// The same inputs for both sides of every comparison: seeded states of an arm. Set-up only.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "reed/bench/stopwatch.h"

namespace reed::bench {

template <int N>
struct Input {
  Eigen::Matrix<double, N, 1> q, qd, v, v_dot;
};

template <int N>
class Inputs {
 public:
  explicit Inputs(std::uint32_t seed = 1) : inputs_(kInputs) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> angle(-1.5, 1.5), speed(-1.0, 1.0), rate(-5.0, 5.0);
    for (Input<N>& input : inputs_) {
      for (int i = 0; i < N; ++i) {
        input.q[i] = angle(engine);
        input.qd[i] = speed(engine);
        input.v[i] = speed(engine);
        input.v_dot[i] = rate(engine);
      }
    }
  }

  /// Call k: again and again through all of them.
  const Input<N>& operator[](int k) const { return inputs_[static_cast<std::size_t>(k % kInputs)]; }

 private:
  std::vector<Input<N>> inputs_;
};

}  // namespace reed::bench
