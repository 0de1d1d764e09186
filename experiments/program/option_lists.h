#pragma once
// Options that are lists between commas.

#include <cstddef>
#include <string>
#include <vector>

namespace kds {

/// Structures by name, in the order of the registry whatever the order given, so that the same set gives the
/// same run. Throws InputError.
[[nodiscard]] std::vector<std::string> parse_structures(const std::string& list);

/// Strides, ascending. Throws InputError.
[[nodiscard]] std::vector<std::size_t> parse_strides(const std::string& list);

}  // namespace kds
