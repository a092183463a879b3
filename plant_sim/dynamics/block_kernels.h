// The two dense loops in which the plant spends its time, on plain arrays of one fixed size so that they
// vectorise. Where the compiler can choose the processor at start, there is a copy for AVX2 with fused
// multiply-add. RT: safe.
#pragma once

namespace reed::plant {

inline constexpr int kBlockSize = 16;  // [e | base rate] of one element; four AVX2 registers

/// Upper triangle (by blocks of four columns) of M += Xᵀ I X, with M 16x16, X 6x16, I 6x6, all row by row.
void AddCongruence(double* M, const double* X, const double* I);

/// Eliminates the first `pivots` unknowns of the symmetric system M k + p = 0, of which the upper triangle is
/// given. Row r < pivots is left as it was when it was the pivot row; inverse[r] = 1/pivot.
void EliminateLeading(double* M, double* p, double* inverse, int pivots);

}  // namespace reed::plant
