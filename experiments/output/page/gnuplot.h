#pragma once
// Runs gnuplot as a function that takes a script and returns its output.

#include <string>
#include <string_view>

namespace kds {

/// Throws an InputError which says that `option` needs gnuplot if gnuplot cannot be started or cannot draw
/// SVG.
void require_gnuplot(std::string_view option);

/// Throws std::runtime_error with gnuplot's message.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

}  // namespace kds
