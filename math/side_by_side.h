// Matrices of pairs: two matrices of the same size side by side. RT: safe.
#pragma once

#include <Eigen/Core>

#include "reed/math/pair.h"

namespace reed::math {

/// The numbers of a vector, and of a vector of pairs the first of each and the second.
template <typename Vector, typename Out>
void Split(const Vector& values, Out&& out) {
  out = values;
}
template <typename Vector, typename First, typename Second>
void Split(const Vector& pairs, First&& first, Second&& second) {
  for (int k = 0; k < static_cast<int>(pairs.size()); ++k) {
    first(k) = pairs(k).first();
    second(k) = pairs(k).second();
  }
}

/// Three rows of linear and three of angular parts: side by side where a pair is quicker, else as they are. SumOf of what a product
/// over the rows gives is the same to the bit: Eigen adds the sum of the upper half and the sum of the lower.
template <int C>
auto Halved(const Eigen::Matrix<double, 6, C>& rows) {
  if constexpr (Pair::kAtOnce) {
    Eigen::Matrix<Pair, 3, C> pairs;
    for (int j = 0; j < C; ++j)
      for (int i = 0; i < 3; ++i) pairs(i, j) = Pair(rows(i, j), rows(i + 3, j));
    return pairs;
  } else {
    return rows;
  }
}

}  // namespace reed::math
