# The same bits from every compiler, at every optimisation and on every processor, for the whole tree: Eigen's inline functions must
# be the same in each source. No multiply-add fused by the compiler. Eigen without vectors of its own: their width would be the
# order of its sums. Compilers still vectorise what keeps the order.
set(REED_SAME_BITS_FLAGS -ffp-contract=off)
set(REED_SAME_BITS_DEFINITIONS EIGEN_DONT_VECTORIZE)
# GCC stops to inline Eigen's scalar loops in the large translation units of the controller: a control step took 1.12 times as long.
set(REED_INLINE_MORE $<$<CXX_COMPILER_ID:GNU>:--param=inline-unit-growth=200>)
add_compile_options(${REED_SAME_BITS_FLAGS})
add_compile_definitions(${REED_SAME_BITS_DEFINITIONS})
