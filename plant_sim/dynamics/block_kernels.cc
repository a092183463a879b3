#include "reed/plant/dynamics/block_kernels.h"

#include <cstddef>
#include <cstring>

#include "reed/plant/dynamics/processor_clones.h"
#include "reed/plant/dynamics/small_products.h"

namespace reed::plant {

namespace {

constexpr int kN = kBlockSize;
constexpr int kGroups = kN / kLanes;  // of columns

inline const GroupInMemory& At(const double* row, int group) {
  return GroupAt(row + std::ptrdiff_t{kLanes} * group);
}
inline GroupInMemory& At(double* row, int group) { return GroupAt(row + std::ptrdiff_t{kLanes} * group); }
inline const double* Row(const double* block, int r) { return block + std::ptrdiff_t{kN} * r; }
inline double* Row(double* block, int r) { return block + std::ptrdiff_t{kN} * r; }

}  // namespace

REED_CLONES void AddCongruence(double* __restrict M, const double* __restrict X, const double* __restrict I) {
  for (int g = 0; g < kGroups; ++g) {
    Group IX[6];
    for (int i = 0; i < 6; ++i) {
      const double* const I_i = I + std::ptrdiff_t{6} * i;
      IX[i] = I_i[0] * At(X, g).v;
      for (int j = 1; j < 6; ++j) IX[i] += I_i[j] * At(Row(X, j), g).v;
    }
    for (int r = 0; r < kLanes * (g + 1); ++r) {  // the diagonal lies in this group or to its left
      Group sum = At(Row(M, r), g).v;
      for (int j = 0; j < 6; ++j) sum += X[kN * j + r] * IX[j];
      At(Row(M, r), g).v = sum;
    }
  }
}

REED_CLONES void EliminateLeading(double* __restrict M, double* __restrict p, double* __restrict inverse) {
  double q[kN];
  std::memcpy(q, p, sizeof q);
  for (int k = 0; k < kPivots; ++k) {
    const double* const source = Row(M, k);
    const double inv = 1.0 / source[k];
    inverse[k] = inv;
    p[k] = q[k];
    const double q_scaled = q[k] * inv;
    Group scaled[kGroups];
    for (int g = 0; g < kGroups; ++g) {
      scaled[g] = inv * At(source, g).v;
      At(q, g).v -= q_scaled * At(source, g).v;  // entries up to k are spent
    }
    // By symmetry the entry below the pivot in row r is source[r].
#pragma GCC unroll 4
    for (int row_group = 0; row_group < kGroups; ++row_group) {
      const int first = row_group * kLanes;
      for (int r = k < first ? first : k + 1; r < first + kLanes; ++r)
#pragma GCC unroll 4
        for (int g = row_group; g < kGroups; ++g) At(Row(M, r), g).v -= source[r] * scaled[g];
    }
  }
  std::memcpy(p + kPivots, q + kPivots, (kN - kPivots) * sizeof(double));
}

REED_CLONES void BackSubstitute(const double* __restrict M, const double* __restrict p,
                                const double* __restrict inverse, double* __restrict k) {
  static_assert(kPivots + 2 == kN - kLanes);
  double rest[kPivots];  // of row r, without what is still to come of k[0 ... r]
  for (int r = 0; r < kPivots; ++r) {
    const double* const row = Row(M, r);
    const Group last = At(row, kGroups - 1).v * At(k, kGroups - 1).v;
    rest[r] = (p[r] + (row[kPivots] * k[kPivots] + row[kPivots + 1] * k[kPivots + 1])) +
              ((last[0] + last[1]) + (last[2] + last[3]));
  }
#pragma GCC unroll 10
  for (int r = kPivots - 1; r >= 0; --r) {
    k[r] = -rest[r] * inverse[r];
#pragma GCC unroll 10
    for (int above = 0; above < r; ++above) rest[above] += Row(M, above)[r] * k[r];
  }
}

}  // namespace reed::plant
