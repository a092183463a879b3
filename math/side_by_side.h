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

}  // namespace reed::math
