// std::array with a signed index, as Eigen's: joints and links are counted by one kind of integer. RT: safe.
#pragma once

#include <cassert>
#include <cstddef>

namespace reed::model {

template <typename T, int N>
class FixedArray {  // NOLINT(bugprone-reserved-identifier): in the copy that the compiler writes
 public:
  T& operator[](int i) {
    assert(0 <= i && i < N);
    return data_[i];
  }
  const T& operator[](int i) const {
    assert(0 <= i && i < N);
    return data_[i];
  }

 private:
  T data_[static_cast<std::size_t>(N)];
};

}  // namespace reed::model
