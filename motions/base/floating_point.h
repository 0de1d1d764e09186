#pragma once
// What all filters and proofs here take for granted of the compiler: each operation on doubles is rounded,
// and none is exchanged for another that is equal in real numbers only.

#if defined(__FAST_MATH__)
#error "kds: compiled with -ffast-math; its error bounds hold only without"
#endif
