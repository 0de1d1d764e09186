#pragma once
// Text as it stands in HTML.

#include <string>
#include <string_view>

namespace kds {

/// On one line.
[[nodiscard]] std::string html_escaped(std::string_view text);
/// Lines stay lines.
[[nodiscard]] std::string html_escaped_lines(std::string_view text);

}  // namespace kds
