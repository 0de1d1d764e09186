#pragma once
// Like KDS_LANES_TARGETS (motions/numbers/lanes.h), with a further clone for vectors of eight. For loops over
// beads.

#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define KDS_SCAN_TARGETS gnu::target_clones("avx512f", "avx2", "default"), gnu::flatten, gnu::noinline
#else
#define KDS_SCAN_TARGETS gnu::noinline
#endif
