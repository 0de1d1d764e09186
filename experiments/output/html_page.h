#pragma once
// A page in the program's style, complete in itself, and the pieces it is made of.

#include <string>
#include <string_view>

namespace kds {

/// As it stands in HTML, on one line.
[[nodiscard]] std::string html_escaped(std::string_view text);
/// The same of several lines, which stay lines.
[[nodiscard]] std::string html_escaped_lines(std::string_view text);

/// A page of the program's style around this body, in HTML; the footer says what machine it was.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body);
[[nodiscard]] std::string html_figure(const std::string& svg, const std::string& caption);

}  // namespace kds
