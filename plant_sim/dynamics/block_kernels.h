// The two dense loops in which the plant spends its time, on plain arrays of one fixed size so that they
// vectorise. Where the compiler can choose the processor at start, there is a copy for AVX2. RT: safe.
#pragma once

namespace reed::plant {

inline constexpr int kBlockSize = 16;  // [e | base rate] of one element; four AVX2 registers
inline constexpr int kPivots = 10;     // e

/// Upper triangle (by blocks of four columns) of M += Xᵀ I X, with M 16x16, X 6x16, I 6x6, all row by row.
void AddCongruence(double* M, const double* X, const double* I);

/// Eliminates the first kPivots unknowns of the symmetric system M k + p = 0, of which the upper triangle is
/// given. Row and entry k < kPivots stay as they were when k was eliminated; inverse[k] = 1/pivot.
void EliminateLeading(double* M, double* p, double* inverse);

/// After EliminateLeading: k[0 ... kPivots) from k[kPivots ... kBlockSize).
void BackSubstitute(const double* M, const double* p, const double* inverse, double* k);

}  // namespace reed::plant
