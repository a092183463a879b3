// REED_CLONES before a function: a second copy of it for processors with AVX2, chosen by the loader. Both give the same bits: no
// multiply-add is fused (cmake/ReedSameBits.cmake). Not for inline functions and templates.
#pragma once

// "arch=haswell" would need that very processor and leave its successors with the plain copy.
// A sanitizer's run time is not ready yet when the loader picks one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(REED_SANITIZED)
#define REED_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define REED_CLONES
#endif
