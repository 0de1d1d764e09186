#pragma once
// Parses options whose values are comma-separated lists.

#include <cstddef>
#include <string>
#include <vector>

namespace kds {

/// Returns the names of structures in the order of the registry, whatever the order in `list`. A set of
/// structures therefore always gives the same run. Throws InputError.
[[nodiscard]] std::vector<std::string> parse_structures(const std::string& list);

/// Returns the strides in ascending order. Throws InputError.
[[nodiscard]] std::vector<std::size_t> parse_strides(const std::string& list);

}  // namespace kds
