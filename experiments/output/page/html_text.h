#pragma once
// Escapes text for HTML.

#include <string>
#include <string_view>

namespace kds {

/// Returns the text on one line.
[[nodiscard]] std::string html_escaped(std::string_view text);
/// Returns the text with its line breaks.
[[nodiscard]] std::string html_escaped_lines(std::string_view text);

}  // namespace kds
