#pragma once
// The report page of every command, report.html: one style, self-contained, without scripts and without
// network access. The page begins with the findings and ends with how the page was made and where its data
// are. The page is light or dark, as the reader's system is set, and legible down to the width of a
// telephone.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"

namespace kds {

/// Returns the text on one line.
[[nodiscard]] std::string html_escaped(std::string_view text);
/// Returns the text with its line breaks.
[[nodiscard]] std::string html_escaped_lines(std::string_view text);

struct Page {
  std::string title;
  std::string found;  ///< HTML paragraphs: the findings in words and figures
  std::string body;   ///< HTML: plots and tables by section
  std::string words;  ///< HTML: a glossary; may be empty
  std::vector<std::pair<std::string, std::string>> terms;  ///< plain text: words and their meanings
  std::string command_line;
  Json settings;                  ///< an object, or null if there are no settings
  std::vector<std::string> data;  ///< names of the data files next to the page
  /// Path of a replay page, from the folder of this page; empty if there is none.
  std::filesystem::path replay = {};
};

/// Returns the page with copies of its tables and plots for print, which write_page (print.h) takes out.
[[nodiscard]] std::string html_page(const Page& page);

[[nodiscard]] std::string html_figure(const std::string& svg, const std::string& caption);

/// Returns a section with its heading, or an empty text if the content is empty.
[[nodiscard]] std::string html_section(const std::string& heading, const std::string& content);

struct HtmlRow {
  std::vector<std::string> cells;  ///< plain text; the first is the row's name; missing cells are empty
  bool detail = false;             ///< details the nearest row above that is not a detail
};
/// Returns a table, with its copy for print. The table scrolls sideways if the page is too narrow, and its
/// first column stays in place. `alignment` has '<' (left, text) or '>' (right) for each column, and its last
/// character holds for all further columns. Text breaks into lines.
[[nodiscard]] std::string html_table(const std::vector<std::string>& columns,
                                     const std::vector<HtmlRow>& rows, std::string_view alignment = "<>");

/// Returns a list of terms with their values, given as pairs of label and value.
[[nodiscard]] std::string html_terms(const std::vector<std::pair<std::string, std::string>>& terms);

/// Returns the path of `replay`, a page that this command writes, from `directory`. Returns an empty path
/// without such a page.
[[nodiscard]] std::filesystem::path replay_beside(const std::filesystem::path& directory,
                                                  const std::optional<std::filesystem::path>& replay);

/// Prints the line "report PATH", with the path of the page in this directory.
void print_report_path(const std::filesystem::path& directory);

}  // namespace kds
