// Products of small matrices by columns, four numbers at once. Each sum has one order, from left to right. Groups are the
// compiler's vectors: for AVX2 in the clones, in halves elsewhere. RT: safe.
#pragma once

#include <Eigen/Core>

namespace reed::plant {

inline constexpr int kLanes = 4;

/// Four neighbouring numbers.
typedef double Group __attribute__((vector_size(kLanes * sizeof(double))));

/// The same in memory, where they are aligned as numbers are. A member, because Clang takes a reference to a Group for one to an
/// aligned Group, whatever its type says.
struct [[gnu::packed, gnu::may_alias]] GroupInMemory {
  Group v;
};

[[gnu::always_inline]] inline const GroupInMemory& GroupAt(const double* first) {
  return *reinterpret_cast<const GroupInMemory*>(first);
}
[[gnu::always_inline]] inline GroupInMemory& GroupAt(double* first) {
  return *reinterpret_cast<GroupInMemory*>(first);
}

/// A x.
[[gnu::always_inline]] inline Eigen::Vector4d Times(const Eigen::Matrix4d& A, const Eigen::Vector4d& x) {
  const double* const a = A.data();
  Group sum = GroupAt(a).v * x[0];
  for (int c = 1; c < 4; ++c) sum += GroupAt(a + std::ptrdiff_t{4} * c).v * x[c];
  Eigen::Vector4d y;
  GroupAt(y.data()).v = sum;
  return y;
}

[[gnu::always_inline]] inline Eigen::Vector3d Times(const Eigen::Matrix3d& A, const Eigen::Vector3d& x) {
  Eigen::Vector3d y;
  for (int r = 0; r < 3; ++r) y[r] = A(r, 0) * x[0] + A(r, 1) * x[1] + A(r, 2) * x[2];
  return y;
}

/// R A Rᵀ. The fourth lane of a column is the next column's first number: its results are overwritten or left out.
[[gnu::always_inline]] inline Eigen::Matrix3d Turned(const Eigen::Matrix3d& R, const Eigen::Matrix3d& A) {
  const double* const r = R.data();
  const Group R_0 = GroupAt(r).v, R_1 = GroupAt(r + 3).v, R_2 = {r[6], r[7], r[8], 0.0};
  Group RA[3];
  for (int c = 0; c < 3; ++c) RA[c] = (R_0 * A(0, c) + R_1 * A(1, c)) + R_2 * A(2, c);
  Eigen::Matrix3d out;
  double* const to = out.data();
  for (int c = 0; c < 3; ++c) {
    const Group column = (RA[0] * R(c, 0) + RA[1] * R(c, 1)) + RA[2] * R(c, 2);
    if (c < 2) {
      GroupAt(to + std::ptrdiff_t{3} * c).v = column;
    } else {
      for (int i = 0; i < 3; ++i) to[6 + i] = column[i];
    }
  }
  return out;
}

}  // namespace reed::plant
