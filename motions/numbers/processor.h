#pragma once
// What the libraries were compiled for, and what this processor has.

#include <optional>
#include <string>

namespace kds {

/// Vectors of x86-64-v4: AVX-512 and twice as many registers.
[[nodiscard]] inline bool processor_has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

/// What the libraries need that this processor has not, in a sentence; nothing where they can run. A function
/// of lanes (lanes.h) would end the program there.
[[nodiscard]] std::optional<std::string> missing_in_processor();

}  // namespace kds
