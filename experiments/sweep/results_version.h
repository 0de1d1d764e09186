#pragma once
// The version that results of sweeps are keyed by.

#include <cstdint>

namespace kds {

/// Returns a hash of the C++ sources that results depend on, without comment lines: those of all folders but
/// experiments/sweep. The build computes it (cmake/HashSources.cmake), so a commit that changes documents or
/// comments does not change it.
[[nodiscard]] std::uint64_t results_version();

}  // namespace kds
