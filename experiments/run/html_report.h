#pragma once
// report.html: one page with the table and the plots, complete in itself.

#include <string>
#include <string_view>

#include "experiments/run/run_report.h"

namespace kds {

/// Draws the plots with gnuplot; throws std::runtime_error where it fails.
[[nodiscard]] std::string html_report(const RunReport& report);

[[nodiscard]] std::string html_escaped(std::string_view text);
/// The same of several lines, which stay lines.
[[nodiscard]] std::string html_escaped_lines(std::string_view text);

/// A page of the program's style around this body, in HTML; the footer says what machine it was.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body);
[[nodiscard]] std::string html_figure(const std::string& svg, const std::string& caption);

}  // namespace kds
