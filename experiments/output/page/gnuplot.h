#pragma once
// gnuplot as a function: a script in, what it prints out.

#include <string>
#include <string_view>

namespace kds {

/// Throws InputError saying that `option` needs gnuplot, where it cannot be started or draws no SVG.
void require_gnuplot(std::string_view option);

/// Throws std::runtime_error with gnuplot's own words.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

}  // namespace kds
