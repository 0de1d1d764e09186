#pragma once
// LaTeX for print: text with LaTeX's special characters escaped, and tables in the style of booktabs.

#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/page/html_page.h"

namespace kds {

/// Returns the text on one line, escaped for LaTeX's text mode. Superscript digits, mathematical signs and
/// Greek letters become commands, and other characters beyond ASCII stay as UTF-8.
[[nodiscard]] std::string latex_escaped(std::string_view text);

/// Returns the text of a caption in HTML, with <em>, <strong> and <code> as LaTeX commands. Other tags are
/// left out.
[[nodiscard]] std::string latex_of_html(std::string_view html);

/// Returns a tabular environment with the rules of package booktabs. `alignment` has '<' (left) or '>'
/// (right) for each column, and its last character holds for all further columns. Long headings break into
/// lines. A column of long text is a paragraph, whose lines break. A row of one cell is the name of the
/// rows below it.
[[nodiscard]] std::string latex_table(const std::vector<std::string>& columns,
                                      const std::vector<HtmlRow>& rows, std::string_view alignment);

}  // namespace kds
