// The same inputs for both sides of every comparison: seeded states of an arm. Set-up only.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

namespace reed::bench {

template <int N>
struct Input {
  Eigen::Matrix<double, N, 1> q, qd, v, v_dot;
};

/// `count` states, a power of two so that k & (count - 1) walks through them.
template <int N>
std::vector<Input<N>> Inputs(std::size_t count = 64, std::uint32_t seed = 1) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> angle(-1.5, 1.5), speed(-1.0, 1.0), rate(-5.0, 5.0);
  std::vector<Input<N>> inputs(count);
  for (Input<N>& input : inputs) {
    for (int i = 0; i < N; ++i) {
      input.q[i] = angle(engine);
      input.qd[i] = speed(engine);
      input.v[i] = speed(engine);
      input.v_dot[i] = rate(engine);
    }
  }
  return inputs;
}

}  // namespace reed::bench
