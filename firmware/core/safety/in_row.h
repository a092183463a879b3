// Joints of which something is true for several cycles in a row. RT: safe.
#pragma once

#include <array>

namespace reed::protect {

template <int N>
class InRow {
 public:
  /// row: so many cycles
  explicit InRow(int row) noexcept : row_(row) {}

  void Reset() noexcept { cycles_.fill(0); }

  /// Once per cycle of a joint. True from the row-th cycle on in which it is.
  bool Add(int joint, bool is) noexcept {
    int& cycles = cycles_[static_cast<std::size_t>(joint)];
    cycles = is ? cycles + 1 : 0;
    return cycles >= row_;
  }

 private:
  int row_;
  std::array<int, static_cast<std::size_t>(N)> cycles_{};
};

}  // namespace reed::protect
