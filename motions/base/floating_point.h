#pragma once
// The properties of the compiler that all filters and proofs rely on: each operation on doubles is rounded,
// and no operation is replaced by one that is equal only for real numbers.

#if defined(__FAST_MATH__)
#error "kds: compiled with -ffast-math; its error bounds hold only without"
#endif
