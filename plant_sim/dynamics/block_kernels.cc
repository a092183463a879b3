#include "plant_sim/dynamics/block_kernels.h"

// A sanitizer's run time is not ready yet when the loader picks a copy.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define REED_CLONES __attribute__((target_clones("arch=haswell", "default")))
#else
#define REED_CLONES
#endif

namespace reed::plant {

namespace {
constexpr int kN = kBlockSize;
constexpr int FirstColumn(int row) { return row & ~3; }  // of the block of four that holds the diagonal
}  // namespace

REED_CLONES void AddCongruence(double* __restrict M, const double* __restrict X, const double* __restrict I) {
  double IX[6 * kN];
  for (int i = 0; i < 6; ++i)
    for (int c = 0; c < kN; ++c) {
      double sum = 0.0;
      for (int j = 0; j < 6; ++j) sum += I[6 * i + j] * X[kN * j + c];
      IX[kN * i + c] = sum;
    }
  for (int r = 0; r < kN; ++r)
    for (int b = FirstColumn(r); b < kN; b += 4)
      for (int c = b; c < b + 4; ++c) {
        double sum = M[kN * r + c];
        for (int j = 0; j < 6; ++j) sum += X[kN * j + r] * IX[kN * j + c];
        M[kN * r + c] = sum;
      }
}

REED_CLONES void EliminateLeading(double* __restrict M, double* __restrict p, double* __restrict inverse,
                                  int pivots) {
  for (int k = 0; k < pivots; ++k) {
    double source[kN];
    for (int c = 0; c < kN; ++c) source[c] = M[kN * k + c];
    const double inv = 1.0 / source[k];
    inverse[k] = inv;
    const double p_k = p[k];
    for (int r = k + 1; r < kN; ++r) {
      const double factor = source[r] * inv;  // by symmetry the entry below the pivot
      for (int b = FirstColumn(r); b < kN; b += 4)
        for (int c = b; c < b + 4; ++c) M[kN * r + c] -= factor * source[c];
      p[r] -= factor * p_k;
    }
  }
}

}  // namespace reed::plant
