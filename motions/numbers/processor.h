#pragma once
// The instruction sets that the libraries were compiled for and that this processor supports.

#include <optional>
#include <string>

namespace kds {

/// Returns whether the processor supports x86-64-v4, that is AVX-512 with twice as many vector registers.
[[nodiscard]] inline bool processor_has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

/// Returns a sentence that names the instructions which the libraries need and this processor lacks, or
/// nothing if the libraries can run here. On a processor that lacks them, a function on lanes (lanes.h) would
/// crash.
[[nodiscard]] std::optional<std::string> missing_in_processor();

}  // namespace kds
